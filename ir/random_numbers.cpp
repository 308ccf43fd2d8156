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

/// The first word of pcg4d.
Expression hash_of(Words words) {
    for (Expression& word : words) {
        word = product(word, word.word(1664525)).plus_word(1013904223);
    }
    mix(words);
    for (Expression& word : words) word = word.binary(Op::bits_xor, word.shifted_right(16));
    // Of the second mixing only what the first word needs is emitted: the rest is never read.
    return sum(words[0], product(words[1], words[3]));
}

}  // namespace

ValueId KernelBuilder::random_symmetric(ValueId draw, std::uint64_t key) {
    const Expression column(*this, cell_column());
    const Expression row(*this, cell_row());
    const Expression high = column.word(static_cast<std::uint32_t>(key >> 32));
    const Expression low = column.word(static_cast<std::uint32_t>(key));
    const Expression stream = Expression(*this, draw).binary(Op::bits_xor, high);
    const Expression hash = hash_of({column, row, stream, low});
    // With k the upper 23 bits: (k + ½) · 2^−22 − 1 is (2k + 1 − 2^23) · 2^−23, and so without a
    // rounding.
    const Expression odd = hash.shifted_right(9).shifted_left(1).plus_word(1);
    return (odd.plus_word(-0x800000u).to_number() * 0x1p-23f).id();
}

}  // namespace cascade
