// Words and numbers of a text file, line by line. Numbers are parsed by std::from_chars: fast, and the same
// in every locale. Blank is every byte up to the space; '#' starts a comment; '\' before a line's end joins
// the next line.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pfgeom {

class TextScanner {
  public:
    explicit TextScanner(std::span<const std::uint8_t> bytes)
        : at_(reinterpret_cast<const char*>(bytes.data())), end_(at_ + bytes.size()) {}

    std::int64_t line() const { return line_; }
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

    /// The next word of this line; empty at its end.
    std::string_view word();
    /// The next word of this line as a number. Throws InvalidInput if there is none.
    double number();
    std::int64_t integer();

    /// To the start of the next line; false at the end of the file.
    bool next_line();
    /// To the next word, across lines; false at the end of the file.
    bool seek_word();
    /// The rest of this line as it stands, without its end; moves to the next line.
    std::string_view rest_of_line();

    [[noreturn]] void fail(const std::string& what) const;

  private:
    void skip_blanks();
    bool at_continuation() const;

    const char* at_;
    const char* end_;
    std::int64_t line_ = 1;
};

/// All of `word` as a number; false if it is none. A leading '+' is allowed.
template <class Number>
bool parse(std::string_view word, Number& value) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && stop == word.data() + word.size();
}

/// Upper-case ASCII copy, for words that are written in any case.
std::string upper_case(std::string_view word);

}  // namespace pfgeom
