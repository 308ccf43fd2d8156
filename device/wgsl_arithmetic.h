// Functions of WGSL programs that compute quotients, roots, roundings and fused sums exactly, with
// integers. WebGPU allows errors in all of these, and permits compilers to replace these functions.
//
// Numbers are words, whose denormal values count as zero. c_packed() rounds and packs a number of
// 25 binary digits. A quotient or root begins with the device's inaccurate result. The remainder of
// this result fits into 32 bits, and corrects the last digits.
#pragma once

#include <string_view>

namespace cascade::wgsl {

inline constexpr std::string_view arithmetic = R"(
const C_SIGN = 0x80000000u;
const C_SIZE = 0x7fffffffu;
const C_ONE = 0x3f800000u;
const C_LEAST = 0x00800000u;
const C_INFINITY = 0x7f800000u;
const C_NAN = 0x7fc00000u;
// The word c_call[0].x is 0, but compilers do not know that. So they know no operand, and cannot
// join an operation with the previous one.
fn c_number(c_w: u32) -> f32 { return bitcast<f32>(c_w ^ c_call[0].x); }
fn c_word(c_x: f32) -> u32 { return bitcast<u32>(c_x); }
fn c_flush(c_w: u32) -> u32 { return select(c_w, c_w & C_SIGN, (c_w & C_SIZE) < C_LEAST); }
fn c_true(c_w: u32) -> bool { return (c_w & C_SIZE) >= C_LEAST; }
fn c_truth(c_b: bool) -> u32 { return select(0u, C_ONE, c_b); }
fn c_is_nan(c_w: u32) -> bool { return (c_w & C_SIZE) > C_INFINITY; }
// Integers in the order of the numbers.
fn c_key(c_w: u32) -> i32 {
    let c_size = bitcast<i32>(c_flush(c_w) & C_SIZE);
    return select(c_size, -c_size, c_w >= C_SIGN);
}
fn c_is_less(a: u32, b: u32) -> bool {
    return !c_is_nan(a) && !c_is_nan(b) && c_key(a) < c_key(b);
}
fn c_is_equal(a: u32, b: u32) -> bool {
    return !c_is_nan(a) && !c_is_nan(b) && c_key(a) == c_key(b);
}
fn c_digits(c_size: u32) -> u32 { return (c_size & 0x007fffffu) | C_LEAST; }
// The number twice / 2^24 · 2^(exponent - 127), and a little more if c_more, rounded.
fn c_packed(c_sign: u32, c_exponent: i32, c_twice: u32, c_more: bool) -> u32 {
    var c_rounded_digits = c_twice >> 1u;
    if ((c_twice & 1u) == 1u && (c_more || (c_rounded_digits & 1u) == 1u)) {
        c_rounded_digits += 1u;
    }
    let c_power = c_exponent + i32(c_rounded_digits >> 24u);
    if (c_power < 1) { return c_sign; }
    if (c_power > 254) { return c_sign | C_INFINITY; }
    return c_sign | (u32(c_power) << 23u) | (c_rounded_digits & 0x007fffffu);
}
fn c_quotient(a: u32, b: u32) -> u32 {
    let c_sign = (a ^ b) & C_SIGN;
    let x = a & C_SIZE;
    let y = b & C_SIZE;
    if (x < C_LEAST || y < C_LEAST || x >= C_INFINITY || y >= C_INFINITY) {
        if (x > C_INFINITY || y > C_INFINITY) { return C_NAN; }
        if (x == C_INFINITY && y == C_INFINITY) { return C_NAN; }
        if (x < C_LEAST && y < C_LEAST) { return C_NAN; }
        return c_sign | select(0u, C_INFINITY, x == C_INFINITY || y < C_LEAST);
    }
    let m = c_digits(x);
    let n = c_digits(y);
    let c_below_one = select(0u, 1u, m < n);
    var q = u32((f32(m) / f32(n)) * f32(1u << (24u + c_below_one)));
    var r = bitcast<i32>((m << (24u + c_below_one)) - q * n);
    let c_more = i32(floor(f32(r) / f32(n)));
    q += bitcast<u32>(c_more);
    r -= c_more * i32(n);
    if (r < 0) {
        q -= 1u;
        r += i32(n);
    } else if (r >= i32(n)) {
        q += 1u;
        r -= i32(n);
    }
    let c_exponent = i32(x >> 23u) - i32(y >> 23u) + 127 - i32(c_below_one);
    return c_packed(c_sign, c_exponent, q, r != 0);
}
fn c_root(a: u32) -> u32 {
    let x = a & C_SIZE;
    if (x < C_LEAST) { return a & C_SIGN; }
    if (x > C_INFINITY || a >= C_SIGN) { return C_NAN; }
    if (x == C_INFINITY) { return a; }
    let c_exponent = i32(x >> 23u) - 127;
    let c_odd = u32(c_exponent & 1);
    let c_square = c_digits(x) << (25u + c_odd);
    var s = u32(sqrt(f32(c_digits(x) << c_odd) * 0x1p-23f) * 0x1p24f);
    s += bitcast<u32>(i32(floor(f32(bitcast<i32>(c_square - s * s)) / f32(2u * s))));
    var r = bitcast<i32>(c_square - s * s);
    if (r < 0) {
        s -= 1u;
        r += i32(2u * s + 1u);
    } else if (r > i32(2u * s)) {
        r -= i32(2u * s + 1u);
        s += 1u;
    }
    return c_packed(0u, (c_exponent - i32(c_odd)) / 2 + 127, s, r != 0);
}
// Adding 2^23 removes the fraction. What remains is read as an integer, so that no compiler can
// take the two sums together.
fn c_rounded(a: u32) -> u32 {
    let c_size = a & C_SIZE;
    if (c_size >= 0x4b000000u) { return a; }
    let c_whole = c_word(c_number(c_size) + 8388608.0) - 0x4b000000u;
    return bitcast<u32>(f32(c_whole)) | (a & C_SIGN);
}
// 64-bit integers are pairs: the lower word, the upper word. Bits that are shifted out to the right
// set the last bit.
fn c_right(c_pair: vec2<u32>, n: u32) -> vec2<u32> {
    if (n == 0u) { return c_pair; }
    if (n < 32u) {
        let c_lower = (c_pair.x >> n) | (c_pair.y << (32u - n));
        return vec2<u32>(c_lower | select(0u, 1u, (c_pair.x << (32u - n)) != 0u), c_pair.y >> n);
    }
    if (n < 64u) {
        var c_lost = c_pair.x;
        if (n > 32u) { c_lost |= c_pair.y << (64u - n); }
        return vec2<u32>((c_pair.y >> (n - 32u)) | select(0u, 1u, c_lost != 0u), 0u);
    }
    return vec2<u32>(select(0u, 1u, (c_pair.x | c_pair.y) != 0u), 0u);
}
fn c_left(c_pair: vec2<u32>, n: u32) -> vec2<u32> {
    if (n == 0u) { return c_pair; }
    if (n < 32u) {
        return vec2<u32>(c_pair.x << n, (c_pair.y << n) | (c_pair.x >> (32u - n)));
    }
    return vec2<u32>(0u, c_pair.x << (n - 32u));
}
fn c_minus(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(a.x - b.x, a.y - b.y - select(0u, 1u, a.x < b.x));
}
fn c_fused(a: u32, b: u32, c: u32) -> u32 {
    let x = a & C_SIZE;
    let y = b & C_SIZE;
    let z = c & C_SIZE;
    if (x < C_INFINITY && y < C_INFINITY && z >= C_INFINITY) { return c; }
    if (x >= C_INFINITY || y >= C_INFINITY || x < C_LEAST || y < C_LEAST) {
        return c_add(c_multiply(a, b), c);
    }
    if (z < C_LEAST) { return c_multiply(a, b); }
    // The product of the digits has 48 bits, the factor of each 12 bits.
    let m = c_digits(x);
    let n = c_digits(y);
    let c_middle = (((m & 0xfffu) * (n & 0xfffu)) >> 12u) + (m >> 12u) * (n & 0xfffu) +
        (m & 0xfffu) * (n >> 12u);
    let c_upper = ((m >> 12u) * (n >> 12u) + (c_middle >> 12u)) >> 8u;
    var p = c_left(vec2<u32>(m * n, c_upper), 14u);
    var q = vec2<u32>(0u, c_digits(z) << 6u);
    let c_apart = i32(x >> 23u) + i32(y >> 23u) - i32(z >> 23u) - 126;
    var c_exponent = i32(z >> 23u) - 188;
    if (c_apart > 0) {
        q = c_right(q, u32(c_apart));
        c_exponent += c_apart;
    } else {
        p = c_right(p, u32(-c_apart));
    }
    var c_sign = (a ^ b) & C_SIGN;
    if (c_sign == (c & C_SIGN)) {
        let c_lower = p.x + q.x;
        p = vec2<u32>(c_lower, p.y + q.y + select(0u, 1u, c_lower < p.x));
    } else if (p.y > q.y || (p.y == q.y && p.x >= q.x)) {
        p = c_minus(p, q);
    } else {
        p = c_minus(q, p);
        c_sign = c & C_SIGN;
    }
    if ((p.x | p.y) == 0u) { return 0u; }
    let c_zeros = select(32u + countLeadingZeros(p.x), countLeadingZeros(p.y), p.y != 0u);
    p = c_left(p, c_zeros);
    let c_lost = (p.y & 0x7fu) | p.x;
    return c_packed(c_sign, c_exponent + 190 - i32(c_zeros), p.y >> 7u, c_lost != 0u);
}
)";

/// Sums and products whose denormal results the device flushes.
inline constexpr std::string_view flushed_by_device = R"(
fn c_flush_sum(c_x: f32) -> u32 { return c_word(c_x); }
fn c_product(a: u32, b: u32) -> u32 { return c_word(c_number(a) * c_number(b)); }
fn c_field_word(c_w: u32) -> u32 { return c_w; }
)";

/// The same functions for a device that may flush or keep denormal results. A product just below
/// the least normal number would be rounded up to it, so the product of larger operands decides.
inline constexpr std::string_view flushed_by_kernel = R"(
fn c_flush_sum(c_x: f32) -> u32 { return c_flush(c_word(c_x)); }
fn c_product(a: u32, b: u32) -> u32 {
    let c_first = c_word(c_number(a) * 0x1p32f);
    let c_larger = c_word(c_number(c_first) * c_number(c_word(c_number(b) * 0x1p32f)));
    let c_w = c_word(c_number(a) * c_number(b));
    return select(c_w, c_w & C_SIGN, (c_larger & C_SIZE) < 0x20800000u);
}
fn c_field_word(c_w: u32) -> u32 { return c_flush(c_w); }
)";

/// Functions that call the functions of operations. c_minus_multiple() is sum - times * c with one
/// rounding, for times = 2 or 4.
inline constexpr std::string_view compositions = R"(
fn c_scale(a: u32, b: u32) -> u32 {
    let c_sum = c_word(c_number(b) + 12583166.0);
    let c_half = c_sum >> 1u;
    return c_multiply(c_multiply(a, c_half << 23u), (c_sum - c_half) << 23u);
}
fn c_minus_multiple(c_sum: u32, c_times: f32, c: u32) -> u32 {
    let c_near = c_flush_sum(c_number(c_sum) - c_times * c_number(c));
    let c_part = c_word(c_number(c_sum) * (1.0 / c_times) - c_number(c));
    let c_far = c_word(c_times * c_number(c_part));
    return select(c_near, c_far, (c & C_SIZE) > 0x7e7fffffu);
}
)";

}  // namespace cascade::wgsl
