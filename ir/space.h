// Shapes, smooth noise and seed lattices as functions of a cell's position.
//
// A position has a coordinate along each axis, in a unit in which the longest side of the domain
// has length 1. Along a periodic axis these functions are periodic. An axis of one cell has no
// extent and is left out.
#pragma once

#include "ir/builder.h"

#include <array>
#include <cstdint>
#include <span>

namespace cascade {

/// One axis of the domain, and the coordinate of the cell along it.
struct SpaceAxis {
    ValueId coordinate;  ///< 0 … length.
    double length = 1;   ///< The whole axis.
    bool is_periodic = false;
    bool has_extent = false;  ///< More than one cell.
};

/// x, y, z.
using Space = std::array<SpaceAxis, 3>;

// Shapes (ir/shapes.cpp). Positions and sizes may have fewer values than there are axes. The shape
// then extends through the whole domain along the others. Distances wrap around periodic sides.

/// 1 if the distance to `centre` is less than |radius|, else 0.
ValueId disc(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius);
/// 1 if the distance to `centre` differs from `radius` by less than half of `width`, else 0.
ValueId ring(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius, ValueId width);
/// 1 if along every axis the distance to `centre` is less than half the size, else 0.
ValueId box(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
            std::span<const ValueId> size);
/// exp(−d² / (2 width²)), with the distance d to `centre`.
ValueId gauss(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
              ValueId width);
/// 1 if x differs from `position` by less than half of `width`, else 0.
ValueId stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width);
/// The same for x cos(angle) + y sin(angle): a straight band that does not wrap around.
ValueId turned_stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width,
                      ValueId angle);

/// The source of a position's random numbers: a word that changes when they are drawn anew, and the
/// key of one occurrence in a script.
struct Draw {
    ValueId word;
    std::uint64_t key = 0;
};

inline constexpr int most_octaves = 12;

/// Gradient noise (ir/noise.cpp; K. Perlin, "An image synthesizer", SIGGRAPH 1985, with the fade of
/// his "Improving noise", SIGGRAPH 2002) on a square lattice of side `scale`, in −1 … 1, with mean
/// 0. Each of `octaves` (1 … most_octaves) has half the scale and half the amplitude of the
/// previous one. Their sum is scaled to −1 … 1. Along periodic axes the side of the lattice is the
/// nearest one that divides the axis.
ValueId smooth_noise(KernelBuilder& builder, const Space& space, ValueId scale, int octaves,
                     const Draw& draw);

/// The positions of the seeds of a lattice.
enum class LatticeKind {
    square,   ///< One in the middle of each square of side `spacing`.
    diamond,  ///< Two: at a quarter and at three quarters of both sides (a quincunx).
};

/// Seed lattices (ir/seeds.cpp): 1 within `radius` of a seed, else 0. Each seed is displaced along
/// every axis by a random distance of at most `jitter`. Correct if radius + jitter is at most the
/// spacing. Along periodic axes the spacing is the nearest one that divides the axis.
ValueId seed_lattice(KernelBuilder& builder, const Space& space, LatticeKind kind, ValueId spacing,
                     ValueId radius, ValueId jitter, const Draw& draw);

}  // namespace cascade
