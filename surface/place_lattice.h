// Places on a surface brought to a lattice, so that questions about them have exact answers.
//
// A place is three weights of its triangle's corners. As whole numbers of steps whose sum is
// 2²⁴ they say exactly which place lies on an edge or in a corner, which coincide, and on which
// side of a line a third one lies: an affine map of the triangle changes none of these, so no
// length enters. Rounding moves a place by less than 10⁻⁷ of its triangle's size.
#pragma once

#include "core/result.h"
#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The weight of each corner in steps; their sum is lattice_steps.
using Steps = std::array<std::int64_t, 3>;
inline constexpr std::int64_t lattice_steps = std::int64_t{1} << 24;

struct LatticePlace {
    std::uint32_t triangle = 0;
    Steps steps{lattice_steps, 0, 0};

    /// Corner 0, 1 or 2 if the place is one, otherwise 3.
    std::uint32_t corner() const;
    /// The edge in the middle of which it lies, or 3. Edge k goes from corner k to corner k + 1.
    std::uint32_t edge() const;
};

/// Above 0 where p, q, r turn as the corners of their triangle do, 0 on a line; exact.
inline std::int64_t turn(const Steps& p, const Steps& q, const Steps& r) {
    return (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]);
}

/// Of a place on edge `edge` of its triangle: its steps in the triangle across, of which that edge
/// is number `edge_there`.
Steps steps_across(const Steps& steps, std::uint32_t edge, std::uint32_t edge_there);

/// Brings places to the lattice so that no two of them coincide: of several in the same place the
/// first stays there, and the others are moved into their triangle by some 2⁻¹⁸ of its size.
/// Fails, naming the place, where one is on no triangle of the mesh: weights below −10⁻⁶, or whose
/// sum differs from 1 by more than that, or not finite.
Result<std::vector<LatticePlace>> to_lattice(const SurfaceMesh& mesh,
                                             std::span<const SurfacePlace> places);

}  // namespace cascade
