#include "pfgeom/mesh/text_scanner.h"

#include "pfgeom/base/error.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::size_t kQuoted = 40;  // of a bad word, as much as a message shows

bool is_blank(char c) {
    return static_cast<unsigned char>(c) <= ' ';
}

/// What is wrong in a file may be anything; a message holds plain text.
std::string quoted(std::string_view word) {
    std::string text(word.substr(0, kQuoted));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + text + "'";
}

}  // namespace

bool TextScanner::at_continuation() const {
    if (at_ == end_ || *at_ != '\\') return false;
    const char* next = at_ + 1;
    if (next != end_ && *next == '\r') ++next;
    return next != end_ && *next == '\n';
}

void TextScanner::skip_blanks() {
    for (; at_ != end_; ++at_) {
        if (at_continuation()) {
            at_ = std::find(at_, end_, '\n');
            ++line_;
        } else if (!is_blank(*at_) || *at_ == '\n') {
            return;
        }
    }
}

std::string_view TextScanner::word() {
    skip_blanks();
    const char* begin = at_;
    if (at_ == end_ || *at_ == '#') return {};
    while (at_ != end_ && !is_blank(*at_) && !at_continuation()) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
}

double TextScanner::number() {
    const std::string_view text = word();
    double value = 0;
    if (!parse(text, value))
        fail("a number is expected, not " + (text.empty() ? "the line's end" : quoted(text)));
    return value;
}

std::int64_t TextScanner::integer() {
    const std::string_view text = word();
    std::int64_t value = 0;
    if (!parse(text, value))
        fail("a whole number is expected, not " + (text.empty() ? "the line's end" : quoted(text)));
    return value;
}

bool TextScanner::next_line() {
    at_ = std::find(at_, end_, '\n');
    if (at_ == end_) return false;
    ++at_;
    ++line_;
    return at_ != end_;
}

bool TextScanner::seek_word() {
    do {
        skip_blanks();
        if (at_ != end_ && *at_ != '\n' && *at_ != '#') return true;
    } while (next_line());
    return false;
}

std::string_view TextScanner::rest_of_line() {
    const char* begin = at_;
    at_ = std::find(at_, end_, '\n');
    std::string_view text(begin, static_cast<std::size_t>(at_ - begin));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    if (at_ != end_) {
        ++at_;
        ++line_;
    }
    return text;
}

void TextScanner::fail(const std::string& what) const {
    throw InvalidInput("line " + std::to_string(line_) + ": " + what);
}

std::string upper_case(std::string_view word) {
    std::string text(word);
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
}

}  // namespace pfgeom
