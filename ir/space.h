// Shapes, smooth noise and seed lattices as functions of a cell's position.
//
// A position has a coordinate along each axis. The longest side of the domain is the unit of
// length. Along a periodic axis these functions are periodic. An axis with only one cell has no
// effect.
#pragma once

#include "ir/builder.h"

#include <array>
#include <cstdint>
#include <span>

namespace cascade {

/// One axis of the domain, and the cell's coordinate along it.
struct SpaceAxis {
    ValueId coordinate;  ///< The cell's coordinate, 0 … length.
    double length = 1;   ///< The length of the whole axis, in the same unit.
    bool is_periodic = false;
    bool has_extent = false;  ///< Whether the axis has more than one cell.
};

/// The axes x, y, z.
using Space = std::array<SpaceAxis, 3>;

// Shapes (ir/shapes.cpp). A position or size may have fewer values than there are axes. Along the
// remaining axes the shape extends through the whole domain. Distances wrap around periodic sides.

/// 1 if the distance to `centre` is less than |radius|, else 0.
ValueId disc(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius);
/// 1 if the distance to `centre` differs from `radius` by less than half the `width`, else 0.
ValueId ring(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius, ValueId width);
/// 1 if, along every axis, the distance to `centre` is less than half the size of the box, else 0.
ValueId box(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
            std::span<const ValueId> size);
/// exp(−d² / (2 width²)), where d is the distance to `centre`.
ValueId gauss(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
              ValueId width);
/// 1 if x differs from `position` by less than half the `width`, else 0.
ValueId stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width);
/// 1 if x cos(angle) + y sin(angle) differs from `position` by less than half the `width`, else 0.
/// The stripe is a straight band that does not wrap around.
ValueId turned_stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width,
                      ValueId angle);

/// The source of random numbers that depend on a position.
struct Draw {
    ValueId word;
    std::uint64_t key = 0;
};

inline constexpr int most_octaves = 12;

/// Gradient noise (ir/noise.cpp) in −1 … 1 with mean 0, on a lattice of cubes of side `scale`.
/// Sources: K. Perlin, "An image synthesizer", SIGGRAPH 1985, with the fade function of K. Perlin,
/// "Improving noise", SIGGRAPH 2002. The noise is a sum of `octaves` terms (1 … most_octaves), each
/// of which has half the scale and half the amplitude of the previous term. The sum is scaled to −1
/// … 1. Along a periodic axis, `scale` is replaced by the nearest number that divides the length of
/// the axis.
ValueId smooth_noise(KernelBuilder& builder, const Space& space, ValueId scale, int octaves,
                     const Draw& draw);

/// The positions of a lattice's seeds.
enum class LatticeKind {
    square,  ///< One seed in the middle of each square of side `spacing`.
    /// Two seeds in each square: at a quarter and at three quarters of both sides (a quincunx).
    diamond,
};

/// Seed lattices (ir/seeds.cpp): 1 where the distance to a seed is less than `radius`, else 0. Each
/// seed is displaced along every axis by a random distance of at most `jitter`. The result is
/// correct only if radius + jitter is at most the spacing. Along a periodic axis, `spacing` is
/// replaced by the nearest number that divides the length of the axis.
ValueId seed_lattice(KernelBuilder& builder, const Space& space, LatticeKind kind, ValueId spacing,
                     ValueId radius, ValueId jitter, const Draw& draw);

}  // namespace cascade
