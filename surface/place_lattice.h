// Positions on a surface rounded to a lattice, for exact geometric predicates.
//
// A position is given by the weights of its triangle's corners. As integers with the sum 2²⁴,
// weights decide exactly which position is on an edge or at a corner, which positions coincide, and
// on which side of a line a position is. These predicates are invariant under affine maps of the
// triangle, so no length is needed. Rounding moves a position by less than 10⁻⁷ of its triangle's
// size.
#pragma once

#include "core/result.h"
#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The weight of each corner in steps, with the sum lattice_steps.
using Steps = std::array<std::int64_t, 3>;
inline constexpr std::int64_t lattice_steps = std::int64_t{1} << 24;

struct LatticePlace {
    std::uint32_t triangle = 0;
    Steps steps{lattice_steps, 0, 0};

    /// The index of the corner at the position, or 3 if it is not at a corner.
    std::uint32_t corner() const;
    /// The edge whose interior contains the position, or 3 if there is none. Edge k goes from
    /// corner k to corner k + 1.
    std::uint32_t edge() const;
};

/// Positive if p, q, r have the orientation of their triangle's corners; 0 if they are on a line.
/// The result is exact.
inline std::int64_t turn(const Steps& p, const Steps& q, const Steps& r) {
    return (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]);
}

/// Converts a position on edge `edge` of a triangle to steps in the triangle across this edge. In
/// the other triangle, the edge has the index `edge_there`.
Steps steps_across(const Steps& steps, std::uint32_t edge, std::uint32_t edge_there);

/// Rounds positions to the lattice so that no two coincide. If positions coincide, the first stays,
/// and the others move inside their triangle by about 2⁻¹⁸ of its size. Fails with the index of a
/// position that is on no triangle of the mesh, because a weight is below −10⁻⁶ or not finite, or
/// because the sum of the weights differs from 1 by more than 10⁻⁶.
Result<std::vector<LatticePlace>> to_lattice(const SurfaceMesh& mesh,
                                             std::span<const SurfacePlace> places);

}  // namespace cascade
