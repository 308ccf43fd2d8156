// Random numbers: the hash pcg4d (core/hash.h) of cell, draw and key, expanded into operations.
// Both precisions use words of 32 bits, so both draw the same numbers, except that the numbers in
// binary64 have more digits.
#include "ir/expression.h"

#include <array>
#include <cmath>

namespace cascade {
namespace {

using Words = std::array<Expression, 4>;

Expression sum(Expression a, Expression b) { return a.binary(Op::bits_add, b); }
Expression product(Expression a, Expression b) { return a.binary(Op::bits_multiply, b); }

void mix(Words& words) {
    auto& [x, y, z, w] = words;
    x = sum(x, product(y, w));
    y = sum(y, product(z, x));
    z = sum(z, product(x, y));
    w = sum(w, product(y, z));
}

/// The first two words of the result of pcg4d.
struct Hash {
    Expression first;
    Expression second;
};

Hash hash_of(Words words) {
    for (Expression& word : words) {
        word = product(word, word.word(1664525)).plus_word(1013904223);
    }
    mix(words);
    for (Expression& word : words) {
        const Expression low = word.low_word();
        word = low.binary(Op::bits_xor, low.shifted_right(16));
    }
    // In the second round of mixing, emits only the instructions that the first two words need.
    const auto [x, y, z, w] = words;
    const Expression first = sum(x, product(y, w));
    return {first.low_word(), sum(y, product(z, first)).low_word()};
}

/// The hash of cell, draw and key.
Hash hash_of_cell(KernelBuilder& builder, ValueId draw, std::uint64_t key) {
    const auto [first, second] = builder.cell_of_draws();
    const Expression column(builder, first), row(builder, second);
    const Expression high = column.word(static_cast<std::uint32_t>(key >> 32));
    const Expression low = column.word(static_cast<std::uint32_t>(key));
    const Expression stream = Expression(builder, draw).binary(Op::bits_xor, high);
    return hash_of({column, row, stream, low});
}

}  // namespace

ValueId KernelBuilder::random_symmetric(ValueId draw, std::uint64_t key) {
    const auto [first, second] = hash_of_cell(*this, draw, key);
    // With k the upper 23 (52) bits, (k + ½) · 2^−22 − 1 equals (2k + 1 − 2^23) · 2^−23 exactly.
    const int digits = format().fraction_bits;
    const Expression k = digits < 32 ? first.shifted_right(32 - digits)
                                     : first.shifted_left(digits - 32)
                                           .binary(Op::bits_or, second.shifted_right(64 - digits));
    const Expression odd = k.shifted_left(1).plus_word(1);
    const Expression centred = odd.plus_word(-(std::uint64_t{1} << digits));
    return (centred.to_number() * std::ldexp(1.0, -digits)).id();
}

ValueId KernelBuilder::draw_word(ValueId uniform) {
    return precision() == Precision::single ? uniform : Expression(*this, uniform).low_word().id();
}

/// √(−2 ln a) cos(2π b) for two uniform random numbers a and b (G. E. P. Box, M. E. Muller, "A note
/// on the generation of random normal deviates", Annals of Mathematical Statistics 29, 1958). a has
/// 31 bits, so that large results are as rare as in a Gaussian distribution.
ValueId KernelBuilder::random_normal(ValueId draw, std::uint64_t key) {
    const auto [first, second] = hash_of_cell(*this, draw, key);
    constexpr ByPrecision<double> two_pi = {0x1.921fb6p+2, 0x1.921fb54442d18p+2};
    const Expression a = (first.shifted_right(1).to_number() + 0.5) * 0x1p-31;
    // Moves the lower 32 bits of the word to the upper end, because the word is read as a signed
    // number.
    const int bits = format().bits;
    const Expression signed_word = bits == 32 ? second : second.shifted_left(bits - 32);
    const Expression angle = signed_word.to_number() * std::ldexp(a.pick(two_pi), -bits);
    const Expression minus_twice = Expression(*this, logarithm(a.id())) * -2;
    const Expression distance = minus_twice.unary(Op::square_root);
    return (distance * Expression(*this, cosine(angle.id()))).id();
}

}  // namespace cascade
