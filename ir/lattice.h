// A lattice over the domain, and a hash of the lattice's points. Smooth noise and seed lattices are
// made from both.
//
// Internal to ir/.
#pragma once

#include "ir/expression.h"
#include "ir/space.h"

namespace cascade {

/// The lattice along one axis.
struct LatticeAxis {
    Expression side;      ///< The width of a lattice cell, in the unit of coordinates.
    Expression count;     ///< The number of lattice cells along a periodic axis: an integer.
    Expression position;  ///< The coordinate of the cell of the domain, divided by `side`.
    bool is_periodic;
};

/// Makes a lattice along one axis, with cells of width `side`. The axis must have at most 2^20 of
/// these cells. Along a periodic axis the width is adjusted so that the number of lattice cells is
/// an integer of at least 1.
LatticeAxis lattice_axis(KernelBuilder& builder, const SpaceAxis& axis, Expression side);

/// The largest integer that is at most the position. If the position is itself an integer, rounding
/// may give the previous integer.
Expression lattice_floor(Expression position);

/// Converts an index along an axis, −1 … count, to a word. Along a periodic axis, indices beyond
/// the ends wrap around.
Expression lattice_word(const LatticeAxis& axis, Expression index);

/// The hash of a lattice point: a sum of products of its indices, mixed by lowbias32 (C. Wellons,
/// "Hash function prospector", 2018, public domain), with a second key mixed in between the two
/// products of lowbias32.
class LatticeHash {
public:
    /// `stream` distinguishes several hashes that are made for the same draw.
    LatticeHash(KernelBuilder& builder, const Draw& draw, std::uint32_t stream);

    /// The contribution of `word`, the point's index along axis 0, 1 or 2.
    Expression part(std::size_t axis, Expression word) const;
    /// The hash, given the sum of the contributions of all axes.
    Expression mixed(Expression parts) const;

private:
    Expression start_;
    std::uint32_t second_key_;
};

/// A random number in [−1, 1), made from bits of a random word. `which` selects one of three
/// numbers that the same word gives.
Expression signed_fraction(Expression word, std::size_t which);

}  // namespace cascade
