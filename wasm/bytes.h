// The numbers and lists of the binary format: WebAssembly Core Specification 2.0, section 5.2.
//
// Internal to wasm/.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace cascade::wasm {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& to, const Bytes& bytes);
/// LEB128: seven bits a byte, the lowest first. The top bit says that more follow.
void append_unsigned(Bytes& to, std::uint64_t number);
/// The same, in two's complement.
void append_signed(Bytes& to, std::int64_t number);
/// The number of bytes, then the bytes.
void append_sized(Bytes& to, const Bytes& bytes);
void append_name(Bytes& to, std::string_view name);

}  // namespace cascade::wasm
