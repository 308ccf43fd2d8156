// Gradient noise. Every lattice point has a random gradient, whose components are independent and
// uniform in (−1, 1). The gradient of a lattice point defines a linear function that is 0 at the
// point. Between the lattice points, their linear functions are blended.
#include "ir/lattice.h"

#include "core/check.h"

#include <vector>

namespace cascade {
namespace {

/// The two lattice points around a cell along one axis.
struct Pair {
    std::size_t axis;                 ///< 0, 1 or 2.
    std::array<Expression, 2> parts;  ///< The points' contributions to hashes.
    /// The distances from the two points to the cell: 0 … 1 from the first, −1 … 0 from the second.
    std::array<Expression, 2> away;
    Expression blend;  ///< 0 if the cell is at the first point, 1 if it is at the second.
};

/// Blends smoothly from 0 to 1: 6 t^5 − 15 t^4 + 10 t³.
Expression fade(Expression t) { return ((t * t) * t) * (t * (t * 6 - 15) + 10); }

Pair pair_along(const LatticeHash& hash, std::size_t axis, const LatticeAxis& lattice) {
    const Expression first = lattice_floor(lattice.position);
    const Expression t = lattice.position - first;
    return {axis,
            {hash.part(axis, lattice_word(lattice, first)),
             hash.part(axis, lattice_word(lattice, first + 1))},
            {t, t - 1},
            fade(t)};
}

/// The value at the cell of one lattice point's linear function. Bit k of `corner` selects one of
/// the two points of pair k.
Expression plane_of(const LatticeHash& hash, const std::vector<Pair>& pairs, std::size_t corner) {
    const auto side = [corner](std::size_t k) { return (corner >> k) & 1; };
    Expression parts = pairs[0].parts[side(0)];
    for (std::size_t k = 1; k < pairs.size(); ++k) {
        parts = parts.binary(Op::bits_add, pairs[k].parts[side(k)]);
    }
    const Expression word = hash.mixed(parts);
    Expression sum = signed_fraction(word, 0) * pairs[0].away[side(0)];
    for (std::size_t k = 1; k < pairs.size(); ++k) {
        sum = sum + signed_fraction(word, k) * pairs[k].away[side(k)];
    }
    return sum;
}

Expression octave(KernelBuilder& builder, const Space& space, Expression side, const Draw& draw,
                  int number) {
    const LatticeHash hash(builder, draw, static_cast<std::uint32_t>(number));
    std::vector<Pair> pairs;
    for (std::size_t axis = 0; axis < space.size(); ++axis) {
        if (!space[axis].has_extent) continue;
        pairs.push_back(pair_along(hash, axis, lattice_axis(builder, space[axis], side)));
    }
    if (pairs.empty()) return side.number(0);
    std::vector<Expression> values;
    for (std::size_t corner = 0; corner < std::size_t{1} << pairs.size(); ++corner) {
        values.push_back(plane_of(hash, pairs, corner));
    }
    for (const Pair& pair : pairs) {
        for (std::size_t k = 0; 2 * k < values.size(); ++k) {
            const Expression rise = values[2 * k + 1] - values[2 * k];
            values[k] = values[2 * k] + pair.blend * rise;
        }
        values.resize(values.size() / 2, side);
    }
    // The largest possible sum is half the number of axes. It is reached if all gradients point to
    // the middle.
    return values[0] * (2.0 / static_cast<double>(pairs.size()));
}

}  // namespace

ValueId smooth_noise(KernelBuilder& builder, const Space& space, ValueId scale, int octaves,
                     const Draw& draw) {
    CHECK(octaves >= 1 && octaves <= most_octaves, "noise: the checker has counted the octaves");
    const Expression side(builder, scale);
    Expression sum = octave(builder, space, side, draw, 0);
    double weight = 1;
    double weights = 1;
    for (int number = 1; number < octaves; ++number) {
        weight *= 0.5;
        weights += weight;
        sum = sum + octave(builder, space, side * weight, draw, number) * weight;
    }
    return octaves == 1 ? sum.id() : (sum * (1 / weights)).id();
}

}  // namespace cascade
