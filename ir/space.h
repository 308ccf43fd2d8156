// Functions of the place of a cell: shapes, smooth noise and lattices of seeds, expanded into
// operations of the table.
//
// A place is a coordinate along each axis, in the unit in which the longest side of the domain has
// the length 1. Where an axis is periodic all of these are periodic along it. An axis of one cell
// has no extent and is left out.
#pragma once

#include "ir/builder.h"

#include <array>
#include <cstdint>
#include <span>

namespace cascade {

/// One axis of the domain, and where the cell is along it.
struct SpaceAxis {
    ValueId coordinate = 0;  ///< 0 … length.
    double length = 1;       ///< Of the whole side.
    bool is_periodic = false;
    bool has_extent = false;  ///< More than one cell.
};

/// x, y, z.
using Space = std::array<SpaceAxis, 3>;

// Shapes (ir/shapes.cpp). Positions and sizes may have fewer values than there are axes: the shape
// then goes through the whole domain along the others. Across periodic sides the shortest distance
// counts.

/// 1 where the distance to `centre` is less than `radius`, whatever its sign, else 0.
ValueId disc(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius);
/// 1 where the distance to `centre` differs from `radius` by less than half of `width`.
ValueId ring(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius, ValueId width);
/// 1 where every distance to `centre` is less than half the size along its axis.
ValueId box(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
            std::span<const ValueId> size);
/// exp(−d² / (2 width²)) of the distance d to `centre`.
ValueId gauss(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
              ValueId width);
/// 1 where x differs from `position` by less than half of `width`.
ValueId stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width);
/// The same of x cos(angle) + y sin(angle): a straight band that does not go on across sides.
ValueId turned_stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width,
                      ValueId angle);

/// Where random numbers of a place come from: a word that changes when they are drawn anew, and the
/// key of one occurrence in a script.
struct Draw {
    ValueId word = 0;
    std::uint64_t key = 0;
};

inline constexpr int most_octaves = 12;

/// Smooth noise (ir/noise.cpp): gradient noise (K. Perlin, "An image synthesizer", SIGGRAPH 1985,
/// with the fade of his "Improving noise", SIGGRAPH 2002) on a square lattice of side `scale`,
/// in −1 … 1, of mean 0. Each of `octaves` (1 … most_octaves) has half the scale and half the
/// height of the one before; their sum is brought back to −1 … 1. Along periodic axes the side of
/// the lattice is the nearest one that fits a whole number of times.
ValueId smooth_noise(KernelBuilder& builder, const Space& space, ValueId scale, int octaves,
                     const Draw& draw);

/// Where the seeds of a lattice are.
enum class LatticeKind {
    square,   ///< One in the middle of each square of side `spacing`.
    diamond,  ///< Two: at a quarter and at three quarters of both sides (a quincunx).
};

/// Lattices of seeds (ir/seeds.cpp): 1 within `radius` of a seed, else 0. Each seed is moved along
/// every axis by a random distance of at most `jitter`. Right as long as radius + jitter is not
/// above the spacing; along periodic axes that is the nearest one that fits a whole number of
/// times.
ValueId seed_lattice(KernelBuilder& builder, const Space& space, LatticeKind kind, ValueId spacing,
                     ValueId radius, ValueId jitter, const Draw& draw);

}  // namespace cascade
