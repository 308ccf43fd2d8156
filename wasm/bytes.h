// The numbers and lists of the binary format: WebAssembly Core Specification 2.0, section 5.2.
//
// Internal to wasm/.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace cascade::wasm {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const Bytes& bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

/// LEB128: seven bits a byte, the lowest first; the top bit says that more follow.
inline void append_unsigned(Bytes& to, std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) to.push_back(static_cast<std::uint8_t>(number | 0x80));
    to.push_back(static_cast<std::uint8_t>(number));
}

/// The same, in two's complement.
inline void append_signed(Bytes& to, std::int64_t number) {
    for (; number < -0x40 || number >= 0x40; number >>= 7) {
        to.push_back(static_cast<std::uint8_t>((number & 0x7f) | 0x80));
    }
    to.push_back(static_cast<std::uint8_t>(number & 0x7f));
}

/// Bytes after their number.
inline void append_sized(Bytes& to, const Bytes& bytes) {
    append_unsigned(to, bytes.size());
    append(to, bytes);
}

inline void append_name(Bytes& to, std::string_view name) {
    append_sized(to, Bytes(name.begin(), name.end()));
}

}  // namespace cascade::wasm
