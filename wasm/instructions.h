// The WebAssembly instructions that kernels use, with their codes (WebAssembly Core Specification
// 2.0, section 5.4).
//
// Internal to wasm/.
#pragma once

#include <cstdint>

namespace cascade::wasm {

/// Instructions on numbers and addresses, and control.
enum class Plain : std::uint8_t {
    block = 0x02,
    loop = 0x03,
    end = 0x0b,
    branch_if = 0x0d,
    call = 0x10,
    get = 0x20,
    set = 0x21,
    tee = 0x22,
    load = 0x28,
    long_load = 0x29,
    load_16_signed = 0x2e,
    store = 0x36,
    long_store = 0x37,
    constant = 0x41,
    equal_zero = 0x45,
    less = 0x48,
    less_unsigned = 0x49,
    greater_equal = 0x4e,
    greater_equal_unsigned = 0x4f,
    add = 0x6a,
    subtract = 0x6b,
    multiply = 0x6c,
    bits_and = 0x71,
    shift_left = 0x74,
    shift_right = 0x76,  ///< Fills with zeros from the left.
    long_shift_left = 0x86,
    long_shift_right = 0x88,
    extend = 0xad,  ///< From i32 to i64.
    long_to_number = 0xb9,
};

/// Instructions on vectors of 128 bits as a whole, or on lanes of only one width. In the binary
/// format the byte 0xfd precedes the code.
enum class Whole : std::uint8_t {
    load = 0x00,
    load_16_splat = 0x08,
    store = 0x0b,
    constant = 0x0c,
    bits_not = 0x4d,
    bits_and = 0x4e,
    bits_and_not = 0x4f,
    bits_or = 0x50,
    bits_xor = 0x51,
    choose = 0x52,  ///< Chooses bit by bit.
    any = 0x53,     ///< The result is 1 if any bit is set.
    load_32_zero = 0x5c,
    widen_8 = 0x89,  ///< Widens the lower half of the lanes, without sign.
    widen_16 = 0xa9,
    widen_32 = 0xc9,
    numbers_of_words = 0xfa,  ///< From signed i32x4 to f32x4.
};

/// Instructions on lanes that exist for 32 and for 64 bits. A vector has four or two lanes.
enum class Lanes : std::uint8_t {
#define CASCADE_LANES(name, single, binary64) name,
#include "wasm/lanes.def"
#undef CASCADE_LANES
};

struct LaneCodes {
    std::uint8_t single, binary64;
};
constexpr LaneCodes codes_of(Lanes instruction) {
    constexpr LaneCodes codes[] = {
#define CASCADE_LANES(name, single, binary64) {single, binary64},
#include "wasm/lanes.def"
#undef CASCADE_LANES
    };
    return codes[static_cast<std::size_t>(instruction)];
}

}  // namespace cascade::wasm
