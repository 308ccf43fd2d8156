// Pieces that several elementary functions are made of.
#include "ir/expression.h"

namespace cascade {
namespace {

// The sum of 1.5 · 2^23 and a smaller number has no digits behind the point, and its last bits are
// the whole number in two's complement.
constexpr float rounder = 0x1.8p23f;
constexpr std::uint32_t rounder_bits = 0x4b400000;

// The word of √½: subtracted from a number's word it moves the border between two exponents there.
constexpr std::uint32_t root_half_bits = 0x3f3504f3;
constexpr std::uint32_t one_word = 0x3f800000;

}  // namespace

Expression polynomial(Expression x, std::span<const float> coefficients) {
    Expression sum = x.number(coefficients.back());
    for (std::size_t k = coefficients.size() - 1; k-- > 0;) {
        const Expression product = sum * x;
        sum = product + coefficients[k];
    }
    return sum;
}

Rounded round_to_whole(Expression x) {
    const Expression sum = x + rounder;
    return {sum - rounder, sum.plus_word(-rounder_bits)};
}

Expression scale(Expression x, Expression n) {
    // One factor 2^n may be out of range where the product is not; so there are two, of about the
    // same size. Their exponents plus 127 are the halves of n + 254.
    const Expression sum = n.plus_word(254);
    const Expression first = sum.shifted_right(1);
    const Expression second = sum.binary(Op::bits_subtract, first);
    const Expression scaled = x * first.shifted_left(23);
    return scaled * second.shifted_left(23);
}

Decomposed decompose(Expression x) {
    const Expression moved = x.plus_word(one_word - root_half_bits);
    const Expression significand = moved.and_word(0x007fffff).plus_word(root_half_bits);
    return {significand, moved.shifted_right(23).to_number() - 127.0f};
}

}  // namespace cascade
