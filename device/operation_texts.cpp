// The tables of texts. The file does not compile if an operation lacks a text in one of the
// languages.
#include "device/operation_texts.h"

#include <array>
#include <cstddef>

namespace cascade {
namespace {

namespace opencl_texts {

// Sources.
constexpr std::string_view constant = "$w";
constexpr std::string_view uniform = "$w";
constexpr std::string_view field = "$f[c_at]";
constexpr std::string_view neighbour = "$f[c_at + ($d)]";
constexpr std::string_view laplacian = "c_laplacian($f, c_at C_LINKS)";
constexpr std::string_view link_flow = "c_link_flow($f, $s, c_at C_LINKS)";
constexpr std::string_view link_squares = "c_link_squares($f, c_at C_LINKS)";
constexpr std::string_view link_weighted = "c_gradient($f, c_at, $s C_LINKS)";
constexpr std::string_view gradient_x = "c_gradient($f, c_at, c_links_x C_LINKS)";
constexpr std::string_view gradient_y = "c_gradient($f, c_at, c_links_y C_LINKS)";
constexpr std::string_view gradient_z = "c_gradient($f, c_at, c_links_z C_LINKS)";
constexpr std::string_view theirs = "$f[c_there]";
constexpr std::string_view mask = "$m[c_at] ? C_ONE : 0";
constexpr std::string_view cell_column = "(cw)c_i";
constexpr std::string_view cell_row = "(cw)c_j";
constexpr std::string_view cell_slice = "(cw)c_k";

// Reductions over links. b is the result for earlier links, and a the next value, flushed.
constexpr std::string_view link_sum = "c_flush_sum(c_word(c_number(b) + c_number(a)))";
constexpr std::string_view link_least = "c_is_nan(b) || c_number(b) < c_number(a) ? b : a";
constexpr std::string_view link_greatest = "c_is_nan(b) || c_number(b) > c_number(a) ? b : a";

// Arithmetic. Operands are flushed.
constexpr std::string_view add = "c_flush_sum(c_word(c_number(a) + c_number(b)))";
constexpr std::string_view subtract = "c_flush_sum(c_word(c_number(a) - c_number(b)))";
constexpr std::string_view multiply =
    "c_flush_product(c_number(a) * c_number(b),"
    " (c_number(a) * C_HALF_LARGER) * (c_number(b) * C_HALF_LARGER))";
constexpr std::string_view divide =
    "c_flush_product(c_number(a) / c_number(b), (c_number(a) * C_LARGER) / c_number(b))";
constexpr std::string_view negate = "a ^ C_SIGN";
constexpr std::string_view absolute = "a & ~C_SIGN";
constexpr std::string_view square_root = "c_word(sqrt(c_number(a)))";
constexpr std::string_view round_to_even = "c_word(rint(c_number(a)))";
constexpr std::string_view scale_by_power = "c_scale(a, b)";
constexpr std::string_view multiply_add =
    "c_flush_product(fma(c_number(a), c_number(b), c_number(c)), fma(c_number(a) * C_HALF_LARGER,"
    " c_number(b) * C_HALF_LARGER, c_number(c) * C_LARGER))";

// Comparisons and logic. Operands of comparisons are flushed.
constexpr std::string_view less = "c_number(a) < c_number(b) ? C_ONE : 0";
constexpr std::string_view less_equal = "c_number(a) <= c_number(b) ? C_ONE : 0";
constexpr std::string_view equal = "c_number(a) == c_number(b) ? C_ONE : 0";
constexpr std::string_view not_equal = "c_number(a) != c_number(b) ? C_ONE : 0";
constexpr std::string_view logical_and = "c_true(a) & c_true(b) ? C_ONE : 0";
constexpr std::string_view logical_or = "c_true(a) | c_true(b) ? C_ONE : 0";
constexpr std::string_view logical_not = "c_true(a) ? 0 : C_ONE";
constexpr std::string_view select = "c_true(a) ? b : c";

// Words.
constexpr std::string_view bits_add = "a + b";
constexpr std::string_view bits_subtract = "a - b";
constexpr std::string_view bits_multiply = "a * b";
constexpr std::string_view bits_and = "a & b";
constexpr std::string_view bits_or = "a | b";
constexpr std::string_view bits_xor = "a ^ b";
constexpr std::string_view bits_shift_left = "a << (b & (8 * sizeof(cw) - 1))";
constexpr std::string_view bits_shift_right = "a >> (b & (8 * sizeof(cw) - 1))";
constexpr std::string_view bits_to_number = "c_word((cn)(ci)a)";

}  // namespace opencl_texts

namespace wgsl_texts {

// Sources.
constexpr std::string_view constant = "$w";
constexpr std::string_view uniform = "$w";
constexpr std::string_view field = "c_planes[$f + c_at]";
constexpr std::string_view neighbour = "c_planes[$f + c_at + ($d)]";
constexpr std::string_view laplacian = "c_laplacian($f, c_at)";
constexpr std::string_view link_flow = "c_link_flow($f, $s, c_at)";
constexpr std::string_view link_squares = "c_link_squares($f, c_at)";
constexpr std::string_view link_weighted = "c_link_weighted($f, $s, c_at)";
constexpr std::string_view gradient_x = "c_gradient($f, c_at, c_call[2].x)";
constexpr std::string_view gradient_y = "c_gradient($f, c_at, c_call[2].y)";
constexpr std::string_view gradient_z = "c_gradient($f, c_at, c_call[2].z)";
constexpr std::string_view theirs = "c_planes[$f + c_there]";
constexpr std::string_view mask = "c_truth(c_mask($m + c_at))";
constexpr std::string_view cell_column = "u32(c_i)";
constexpr std::string_view cell_row = "u32(c_j)";
constexpr std::string_view cell_slice = "u32(c_k)";

// Reductions over links. b is the result for earlier links, and a the next value, flushed.
constexpr std::string_view link_sum = "c_flush_sum(c_number(b) + c_number(a))";
constexpr std::string_view link_least = "select(a, b, c_is_nan(b) || c_is_less(b, a))";
constexpr std::string_view link_greatest = "select(a, b, c_is_nan(b) || c_is_less(a, b))";

// Arithmetic. Operands are flushed. c_flush_sum() and c_product() let no compiler join a sum or a
// product with the next operation.
constexpr std::string_view add = "c_flush_sum(c_number(a) + c_number(b))";
constexpr std::string_view subtract = "c_flush_sum(c_number(a) - c_number(b))";
constexpr std::string_view multiply = "c_product(a, b)";
constexpr std::string_view divide = "c_quotient(a, b)";
constexpr std::string_view negate = "a ^ C_SIGN";
constexpr std::string_view absolute = "a & C_SIZE";
constexpr std::string_view square_root = "c_root(a)";
constexpr std::string_view round_to_even = "c_rounded(a)";
constexpr std::string_view scale_by_power = "c_scale(a, b)";
constexpr std::string_view multiply_add = "c_fused(a, b, c)";

// Comparisons and logic. Comparisons compare integers that are in the order of the numbers.
constexpr std::string_view less = "c_truth(c_is_less(a, b))";
constexpr std::string_view less_equal = "c_truth(c_is_less(a, b) || c_is_equal(a, b))";
constexpr std::string_view equal = "c_truth(c_is_equal(a, b))";
constexpr std::string_view not_equal = "c_truth(!c_is_equal(a, b))";
constexpr std::string_view logical_and = "c_truth(c_true(a) && c_true(b))";
constexpr std::string_view logical_or = "c_truth(c_true(a) || c_true(b))";
constexpr std::string_view logical_not = "c_truth(!c_true(a))";
constexpr std::string_view select = "select(c, b, c_true(a))";

// Words. The conversion of a word of 16 bits is exact.
constexpr std::string_view bits_add = "a + b";
constexpr std::string_view bits_subtract = "a - b";
constexpr std::string_view bits_multiply = "a * b";
constexpr std::string_view bits_and = "a & b";
constexpr std::string_view bits_or = "a | b";
constexpr std::string_view bits_xor = "a ^ b";
constexpr std::string_view bits_shift_left = "a << (b & 31u)";
constexpr std::string_view bits_shift_right = "a >> (b & 31u)";
constexpr std::string_view bits_to_number =
    "c_word(f32(bitcast<i32>(a) >> 16u) * 65536.0 + f32(a & 0xffffu))";

}  // namespace wgsl_texts

constexpr std::array<std::string_view, op_count> opencl_table{
#define CASCADE_OPERATION(name, arity, payload, meaning) opencl_texts::name,
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

constexpr std::array<std::string_view, op_count> wgsl_table{
#define CASCADE_OPERATION(name, arity, payload, meaning) wgsl_texts::name,
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

}  // namespace

std::string_view text_of(Op op, TextLanguage language) {
    const auto number = static_cast<std::size_t>(op);
    return language == TextLanguage::opencl ? opencl_table[number] : wgsl_table[number];
}

}  // namespace cascade
