// Writes numbers and lists in WebAssembly's binary format (WebAssembly Core Specification 2.0,
// section 5.2).
//
// Internal to wasm/.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace cascade::wasm {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& to, const Bytes& bytes);
/// Appends an unsigned number in LEB128: seven bits per byte, lowest bits first. The top bit of a
/// byte says that more bytes follow.
void append_unsigned(Bytes& to, std::uint64_t number);
/// Appends a signed number in LEB128, in two's complement.
void append_signed(Bytes& to, std::int64_t number);
/// Appends the number of bytes, then the bytes.
void append_sized(Bytes& to, const Bytes& bytes);
void append_name(Bytes& to, std::string_view name);

}  // namespace cascade::wasm
