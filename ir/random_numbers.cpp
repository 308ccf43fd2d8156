// Random numbers: the hash pcg4d (core/hash.h) of cell, draw and key, expanded into operations.
#include "ir/expression.h"

#include <array>

namespace cascade {
namespace {

using Words = std::array<Expression, 4>;

Expression sum(Expression a, Expression b) {
    return a.binary(Op::bits_add, b);
}
Expression product(Expression a, Expression b) {
    return a.binary(Op::bits_multiply, b);
}

void mix(Words& words) {
    auto& [x, y, z, w] = words;
    x = sum(x, product(y, w));
    y = sum(y, product(z, x));
    z = sum(z, product(x, y));
    w = sum(w, product(y, z));
}

/// The first two words of pcg4d.
struct Hash {
    Expression first;
    Expression second;
};

Hash hash_of(Words words) {
    for (Expression& word : words) {
        word = product(word, word.word(1664525)).plus_word(1013904223);
    }
    mix(words);
    for (Expression& word : words) word = word.binary(Op::bits_xor, word.shifted_right(16));
    // Of the second mixing only what these two words need is emitted: the rest is never read.
    const auto [x, y, z, w] = words;
    const Expression first = sum(x, product(y, w));
    return {first, sum(y, product(z, first))};
}

/// The hash of the cell.
Hash hash_of_cell(KernelBuilder& builder, ValueId draw, std::uint64_t key) {
    const Expression column(builder, builder.cell_column());
    const Expression row(builder, builder.cell_row());
    const Expression high = column.word(static_cast<std::uint32_t>(key >> 32));
    const Expression low = column.word(static_cast<std::uint32_t>(key));
    const Expression stream = Expression(builder, draw).binary(Op::bits_xor, high);
    return hash_of({column, row, stream, low});
}

}  // namespace

ValueId KernelBuilder::random_symmetric(ValueId draw, std::uint64_t key) {
    const Expression hash = hash_of_cell(*this, draw, key).first;
    // With k the upper 23 bits: (k + ½) · 2^−22 − 1 is (2k + 1 − 2^23) · 2^−23, and so without a
    // rounding.
    const Expression odd = hash.shifted_right(9).shifted_left(1).plus_word(1);
    return (odd.plus_word(-0x800000u).to_number() * 0x1p-23f).id();
}

/// √(−2 ln a) cos(2π b) of two uniform numbers a and b (G. E. P. Box, M. E. Muller, "A note on the
/// generation of random normal deviates", Annals of Mathematical Statistics 29, 1958). a has 31 bits,
/// so that large numbers are as rare as they are to be.
ValueId KernelBuilder::random_normal(ValueId draw, std::uint64_t key) {
    const auto [first, second] = hash_of_cell(*this, draw, key);
    const Expression a = (first.shifted_right(1).to_number() + 0.5f) * 0x1p-31f;
    const Expression angle = second.to_number() * 0x1.921fb6p-30f;  // 2π · 2^−32
    const Expression minus_twice = Expression(*this, logarithm(a.id())) * -2.0f;
    const Expression distance = minus_twice.unary(Op::square_root);
    return (distance * Expression(*this, cosine(angle.id()))).id();
}

}  // namespace cascade
