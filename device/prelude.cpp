// Prints the beginning of a program. The functions of operations come from operation_texts.h.
#include "device/prelude.h"

#include "device/operation_texts.h"
#include "ir/word_operations.h"

#include <fmt/format.h>

namespace cascade {
namespace {

constexpr std::string_view single_types = R"(
typedef uint cw;
typedef int ci;
typedef float cn;
#define c_number(w) as_float(w)
#define c_word(x) as_uint(x)
#define C_SIGN 0x80000000u
#define C_ONE 0x3f800000u
#define C_LEAST 0x00800000u
#define C_INFINITY 0x7f800000u
#define C_FRACTION_BITS 23
#define C_HALF_LARGER 0x1p32f
#define C_LARGER 0x1p64f
#define C_LEAST_LARGER 0x1p-62f
#define C_LARGEST_QUARTER 0x1.fffffep125f
#define C_WHOLE_AND_BIASES 12583166.0f
)";

// 12583166 = 3 · 2^22 + 2 · 127, and 6755399441057790 = 3 · 2^51 + 2 · 1023: see scale_by_power()
// in ir/word_operations.h.
constexpr std::string_view double_types = R"(
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef ulong cw;
typedef long ci;
typedef double cn;
#define c_number(w) as_double(w)
#define c_word(x) as_ulong(x)
#define C_SIGN 0x8000000000000000ul
#define C_ONE 0x3ff0000000000000ul
#define C_LEAST 0x0010000000000000ul
#define C_INFINITY 0x7ff0000000000000ul
#define C_FRACTION_BITS 52
#define C_HALF_LARGER 0x1p256
#define C_LARGER 0x1p512
#define C_LEAST_LARGER 0x1p-510
#define C_LARGEST_QUARTER 0x1.fffffffffffffp1021
#define C_WHOLE_AND_BIASES 6755399441057790.0
)";

constexpr std::string_view flush_functions = R"(
cw c_flush(cw w) { return (w & ~C_SIGN) < C_LEAST ? w & C_SIGN : w; }
#ifdef C_DEVICE_FLUSHES
#define c_flush_sum(w) (w)
#define c_flush_product(x, larger) c_word(x)
#else
#define c_flush_sum(w) c_flush(w)
cw c_flush_product(cn x, cn larger) {
    return fabs(larger) < C_LEAST_LARGER ? c_word(x) & C_SIGN : c_word(x);
}
#endif
bool c_true(cw w) { return (w & ~C_SIGN) >= C_LEAST; }
bool c_is_nan(cw w) { return (w & ~C_SIGN) > C_INFINITY; }
)";

constexpr std::string_view scale_function = R"(
cw c_multiply(cw a, cw b);
cw c_scale(cw a, cw b) {
    const cw c_sum = c_word(c_number(b) + C_WHOLE_AND_BIASES), c_half = c_sum >> 1;
    return c_multiply(c_multiply(a, c_half << C_FRACTION_BITS),
                      (c_sum - c_half) << C_FRACTION_BITS);
}
)";

constexpr std::string_view multiple_function = R"(
/* sum - times * c with one rounding, for times = 2 or 4. */
cw c_minus_multiple(cw sum, cn times, cw c) {
#ifdef C_FAST_FMA
    return c_flush_sum(c_word(fma(-times, c_number(c), c_number(sum))));
#else
    const cn c_near = c_number(sum) - times * c_number(c);
    const cn c_far = times * (c_number(sum) * (1 / times) - c_number(c));
    return c_flush_sum(c_word(fabs(c_number(c)) > C_LARGEST_QUARTER ? c_far : c_near));
#endif
}
)";

constexpr std::string_view link_functions = R"(
#define C_LINKS , c_slice, c_lane, c_starts, c_bases, c_offsets, c_weights
#define C_LINK_PARAMETERS , const uint c_slice, const uint c_lane, __global const uint* c_starts, \
    __global const int* c_bases, __global const short* c_offsets, __global const cw* c_weights
#define C_OVER_LINKS(term) \
    cw c_sum = 0; \
    const cw c_own = c_field_word(c_f[c_at]); \
    for (uint c_entry = c_starts[c_slice]; c_entry < c_starts[c_slice + 1]; ++c_entry) { \
        const c_long c_link = (c_long)c_entry * 16 + c_lane; \
        const c_long c_there = c_bases[c_entry] + c_offsets[c_link]; \
        const cw c_apart = c_subtract(c_field_word(c_f[c_there]), c_own); \
        c_sum = c_add(c_sum, c_multiply(c_field_word(c_weights[c_link]), term)); \
    } \
    return c_sum;
cw c_laplacian(__global const cw* c_f, c_long c_at C_LINK_PARAMETERS) { C_OVER_LINKS(c_apart) }
cw c_link_squares(__global const cw* c_f, c_long c_at C_LINK_PARAMETERS) {
    C_OVER_LINKS(c_multiply(c_apart, c_apart))
}
cw c_link_flow(__global const cw* c_f, __global const cw* c_s, c_long c_at C_LINK_PARAMETERS) {
    C_OVER_LINKS(c_multiply(c_add(c_field_word(c_s[c_there]), c_field_word(c_s[c_at])), c_apart))
}
cw c_gradient(__global const cw* c_f, c_long c_at, __global const cw* c_components
              C_LINK_PARAMETERS) {
    c_weights = c_components;
    C_OVER_LINKS(c_apart)
}
)";

/// The functions of operations on operands. `multiply` is declared earlier, for c_scale().
std::string operation_functions() {
    std::string text;
    for (int number = 0; number < op_count; ++number) {
        const Op op = static_cast<Op>(number);
        if (info(op).arity == 0) continue;
        constexpr std::string_view parameters[] = {"cw a", "cw a, cw b", "cw a, cw b, cw c"};
        const int operands = is_link_reduction(op) ? 2 : info(op).arity;
        text += fmt::format("cw c_{}({}) {{ return {}; }}\n", info(op).name,
                            parameters[operands - 1], text_of(op, TextLanguage::opencl));
    }
    return text;
}

}  // namespace

std::string prelude_text(const TextTarget& target) {
    std::string text;
    if (target.flushing == Flushing::by_device) text += "#define C_DEVICE_FLUSHES\n";
    if (target.has_fast_fma) text += "#define C_FAST_FMA\n";
    text += target.precision == Precision::single ? single_types : double_types;
    text += "#pragma OPENCL FP_CONTRACT OFF\n";
    text += target.has_large_planes ? "typedef long c_long;\n" : "typedef int c_long;\n";
    text += flush_functions;
    text += scale_function;
    text += operation_functions();
    text += multiple_function;
    // Sums of numbers from memory. Compilers cannot simplify them, because words from memory are
    // never constants.
    text += target.flushing == Flushing::by_device ? "#define c_field_word(w) (w)\n"
                                                   : "#define c_field_word(w) c_flush(w)\n";
    return text;
}

std::string neighbour_sum(Stencil stencil, const PlaneLayout& layout, std::string_view cell) {
    std::string sum;
    const auto add_pair = [&](std::int64_t first, std::int64_t second) {
        for (const std::int64_t distance : {first, second}) {
            const std::string value =
                fmt::format("c_field_word({})", fmt::format(fmt::runtime(cell), distance));
            sum = sum.empty() ? value : fmt::format("c_add({}, {})", sum, value);
        }
    };
    if (stencil.y) add_pair(-layout.stride, layout.stride);
    if (stencil.x) add_pair(1, -1);
    if (stencil.z) add_pair(-layout.slice_stride, layout.slice_stride);
    return sum;
}

std::string stencil_text(const TextTarget& target, Stencil stencil, const PlaneLayout& layout) {
    if (stencil.links) return std::string(link_functions);
    std::string text = "#define C_LINKS\n#undef c_laplacian\n";
    const std::string sum = neighbour_sum(stencil, layout, "c_f[c_at + ({})]");
    const std::string own = "c_field_word(c_f[c_at])";
    const std::string six = target.precision == Precision::single ? "c_word(6.0f)" : "c_word(6.0)";
    text += "cw c_laplacian(__global const cw* c_f, c_long c_at) {\n    return ";
    text += stencil.axes() == 3
                ? fmt::format("c_subtract({}, c_multiply({}, {}))", sum, six, own)
                : fmt::format("c_minus_multiple({}, {}, {})", sum, 2 * stencil.axes(), own);
    return text + ";\n}\n";
}

std::string link_parameters(const TextTarget&, bool linked) {
    if (!linked) return "";
    return ", __global const uint* c_starts, __global const int* c_bases, "
           "__global const short* c_offsets, __global const ushort* c_filled, "
           "__global const cw* c_weights, __global const cw* c_links_x, "
           "__global const cw* c_links_y, __global const cw* c_links_z";
}

}  // namespace cascade
