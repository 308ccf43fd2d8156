// Lattices along axes, and hashes of lattice points. A periodic axis has a whole number of lattice
// cells. The hash of a point is a sum of three parts, one for each axis, mixed with the key. All
// points with the same index along an axis share the part of that axis.
#include "ir/lattice.h"

#include "core/hash.h"

#include <array>
#include <cmath>

namespace cascade {
namespace {

constexpr double most_cells = 0x1p20;
constexpr std::array<std::uint32_t, 3> axis_factor = {0x9e3779b1, 0x85ebca6b, 0xc2b2ae35};
constexpr std::uint32_t draw_factor = 0x27d4eb2f;

}  // namespace

LatticeAxis lattice_axis(KernelBuilder& builder, const SpaceAxis& axis, Expression side) {
    const Expression coordinate(builder, axis.coordinate);
    const Expression wanted = axis.length / side;
    const Expression count =
        axis.is_periodic
            ? Expression(builder, builder.round_to_even(wanted.id())).clamped(1, most_cells)
            : wanted.clamped(0, most_cells);
    const Expression fitting = axis.is_periodic ? axis.length / count : side;
    return {fitting, count, coordinate * (count / count.number(axis.length)), axis.is_periodic};
}

Expression lattice_floor(Expression position) { return round_to_whole(position - 0.5).number; }

Expression lattice_word(const LatticeAxis& axis, Expression index) {
    if (!axis.is_periodic) return round_to_whole(index).word;
    const Expression before = (index < 0).choose(index + axis.count, index);
    const Expression inside = (before < axis.count).choose(before, before - axis.count);
    return round_to_whole(inside).word;
}

// Mixes the keys, so that keys that differ in one bit give unrelated hashes.
LatticeHash::LatticeHash(KernelBuilder& builder, const Draw& draw, std::uint32_t stream)
    : start_(builder, draw.word), second_key_(0) {
    const auto keys = pcg4d({static_cast<std::uint32_t>(draw.key),
                             static_cast<std::uint32_t>(draw.key >> 32), stream, 0});
    start_ = start_.binary(Op::bits_multiply, start_.word(draw_factor)).plus_word(keys[0]);
    second_key_ = keys[1];
}

Expression LatticeHash::part(std::size_t axis, Expression word) const {
    const Expression product = word.binary(Op::bits_multiply, word.word(axis_factor[axis]));
    return axis == 0 ? product.binary(Op::bits_add, start_) : product;
}

Expression LatticeHash::mixed(Expression h) const {
    h = h.low_word();
    h = h.binary(Op::bits_xor, h.shifted_right(16));
    h = h.binary(Op::bits_multiply, h.word(0x7feb352d)).low_word();
    h = h.binary(Op::bits_xor, h.word(second_key_));
    h = h.binary(Op::bits_xor, h.shifted_right(15));
    h = h.binary(Op::bits_multiply, h.word(0x846ca68b)).low_word();
    return h.binary(Op::bits_xor, h.shifted_right(16));
}

Expression signed_fraction(Expression word, std::size_t which) {
    if (which == 1) word = word.shifted_left(16);
    if (which == 2) word = word.binary(Op::bits_multiply, word.word(0x2545f491));
    // Moves the lower 32 bits of a word to the upper end of the word, because the result is read as
    // a signed number.
    const int bits = word.format().bits;
    if (bits > 32) word = word.shifted_left(bits - 32);
    return word.to_number() * std::ldexp(1.0, 1 - bits);
}

}  // namespace cascade
