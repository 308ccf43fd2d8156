// Steps that several elementary functions share.
#include "ir/expression.h"

#include <cmath>

namespace cascade {
namespace {

/// The bits of √½ as a word. Subtracting this word from the word of a positive number moves the
/// boundary between two exponents from 1 to √½.
constexpr ByPrecision<std::uint64_t> root_half_bits = {0x3f3504f3, 0x3fe6a09e667f3bcd};

}  // namespace

Expression polynomial(Expression x, std::span<const double> coefficients) {
    Expression sum = x.number(coefficients.back());
    for (std::size_t k = coefficients.size() - 1; k-- > 0;) {
        const Expression product = sum * x;
        sum = product + coefficients[k];
    }
    return sum;
}

// Adding 1.5 · 2^23 (in binary64 1.5 · 2^52) to a number of smaller magnitude removes all
// fractional digits. The last bits of the sum are then the integer in two's complement.
Rounded round_to_whole(Expression x) {
    const WordFormat format = x.format();
    const double rounder = std::ldexp(1.5, format.fraction_bits);
    const auto exponent = static_cast<std::uint64_t>(format.bias + format.fraction_bits);
    const std::uint64_t half = std::uint64_t{1} << (format.fraction_bits - 1);
    const Expression sum = x + rounder;
    return {sum - rounder, sum.plus_word(-((exponent << format.fraction_bits) + half))};
}

Decomposed decompose(Expression x) {
    const WordFormat format = x.format();
    const std::uint64_t root_half = x.pick(root_half_bits);
    const Expression moved = x.plus_word(format.one() - root_half);
    const Expression significand = moved.and_word(format.fraction()).plus_word(root_half);
    return {significand, moved.shifted_right(format.fraction_bits).to_number() - format.bias};
}

}  // namespace cascade
