// What noise and lattices of seeds share: a lattice laid over the domain, and a hash of its points.
//
// Internal to ir/.
#pragma once

#include "ir/expression.h"
#include "ir/space.h"

namespace cascade {

/// The lattice along one axis.
struct LatticeAxis {
    Expression side;      ///< Of a lattice cell, in coordinates.
    Expression count;     ///< Cells along a periodic axis: a whole number.
    Expression position;  ///< Of the cell in the lattice: coordinate / side.
    bool is_periodic;
};

/// Cells of about `side`, at most 2^20 along the axis. Along a periodic axis a whole number of
/// them, at least one.
LatticeAxis lattice_axis(KernelBuilder& builder, const SpaceAxis& axis, Expression side);

/// The largest whole number that is not above the position, or at a whole position the one before.
Expression lattice_floor(Expression position);

/// A whole number along an axis as a word; beyond a periodic side that of the opposite one. The
/// number is −1 … count.
Expression lattice_word(const LatticeAxis& axis, Expression index);

/// The hash of lattice points: sums of products, mixed by the function lowbias32 (C. Wellons, "Hash
/// function prospector", 2018, public domain) with a second key between its two products.
class LatticeHash {
public:
    /// `stream` tells hashes of one draw apart.
    LatticeHash(KernelBuilder& builder, const Draw& draw, std::uint32_t stream);

    /// What an index contributes along axis 0, 1 or 2.
    Expression part(std::size_t axis, Expression word) const;
    /// The hash of the sum of all parts.
    Expression mixed(Expression parts) const;

private:
    Expression start_;
    std::uint32_t second_key_;
};

/// A random word as a number in [−1, 1), and two more numbers from the same word.
Expression signed_fraction(Expression word, std::size_t which);

}  // namespace cascade
