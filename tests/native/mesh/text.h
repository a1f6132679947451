// Mesh files as strings, for the readers' tests.
#pragma once

#include "pfgeom/base/error.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace pfgeom {

inline std::vector<std::uint8_t> bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

template <class T>
void append_value(std::string& text, T value, bool big_endian = false) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    text += big_endian ? std::string(std::rbegin(raw), std::rend(raw)) : std::string(raw, sizeof(T));
}

/// What reading complains about; empty if it does not.
template <class Read>
std::string complaint(Read read, std::string_view text) {
    try {
        read(bytes_of(text));
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

}  // namespace pfgeom
