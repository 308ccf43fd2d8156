// The common base of noise and seed lattices: a lattice over the domain, and a hash of its points.
//
// Internal to ir/.
#pragma once

#include "ir/expression.h"
#include "ir/space.h"

namespace cascade {

/// The lattice along one axis.
struct LatticeAxis {
    Expression side;      ///< A lattice cell's side, as a coordinate.
    Expression count;     ///< Lattice cells along a periodic axis: an integer.
    Expression position;  ///< The cell's position in the lattice: coordinate / side.
    bool is_periodic;
};

/// A lattice with cells of width `side`, at most 2^20 along the axis. Along a periodic axis the
/// width is adjusted so that their number is an integer, at least 1.
LatticeAxis lattice_axis(KernelBuilder& builder, const SpaceAxis& axis, Expression side);

/// The largest integer not above the position. At an integral position, possibly the previous one.
Expression lattice_floor(Expression position);

/// An index along an axis, −1 … count, as a word. Beyond a periodic side, it wraps around.
Expression lattice_word(const LatticeAxis& axis, Expression index);

/// The hash of lattice points: sums of products, mixed by lowbias32 (C. Wellons, "Hash function
/// prospector", 2018, public domain) with a second key between its two products.
class LatticeHash {
public:
    /// `stream` distinguishes several hashes of one draw.
    LatticeHash(KernelBuilder& builder, const Draw& draw, std::uint32_t stream);

    /// The contribution of an index along axis 0, 1 or 2.
    Expression part(std::size_t axis, Expression word) const;
    /// The hash of the sum of all parts.
    Expression mixed(Expression parts) const;

private:
    Expression start_;
    std::uint32_t second_key_;
};

/// A random word as a number in [−1, 1). `which` selects one of three numbers from the same word.
Expression signed_fraction(Expression word, std::size_t which);

}  // namespace cascade
