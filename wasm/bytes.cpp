// Appends to lists of bytes. These functions are not inline, because g++ 12 would warn of overflows
// that cannot happen.
#include "wasm/bytes.h"

namespace cascade::wasm {

void append(Bytes& to, const Bytes& bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

void append_unsigned(Bytes& to, std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) to.push_back(static_cast<std::uint8_t>(number | 0x80));
    to.push_back(static_cast<std::uint8_t>(number));
}

void append_signed(Bytes& to, std::int64_t number) {
    for (; number < -0x40 || number >= 0x40; number >>= 7) {
        to.push_back(static_cast<std::uint8_t>((number & 0x7f) | 0x80));
    }
    to.push_back(static_cast<std::uint8_t>(number & 0x7f));
}

void append_sized(Bytes& to, const Bytes& bytes) {
    append_unsigned(to, bytes.size());
    append(to, bytes);
}

void append_name(Bytes& to, std::string_view name) {
    append_sized(to, Bytes(name.begin(), name.end()));
}

}  // namespace cascade::wasm
