// For comparison: the same updates as a good programmer would write them in straight C++, compiled
// by g++ with three sets of flags (see CMakeLists.txt). Simultaneous updates of float fields in
// padded rows, `__restrict` pointers, loops without branches.
#pragma once

#include <cstdint>

namespace cascade::bench {

/// Planes with the same layout. Pointers are to cell (0, 0, 0).
struct StraightFields {
    const float* now[5];         ///< Species of the old step, with their halos filled.
    float* next[5];              ///< Species of the new step.
    const float* varying;        ///< beta of Turing's system, ai of the stripes.
    const std::uint8_t* frozen;  ///< Only for Turing's system, and only if it has a mask.
    /// Written by the first of two passes: Cahn-Hilliard's chemical potential, Perona and Malik's
    /// conductivity, or Swift-Hohenberg's inner operator.
    float* scratch;
    std::int64_t width, height, depth, stride, slice_stride;
};

/// Constants of the systems, in variables so that no compiler can fold them.
struct StraightConstants {
    float speed = 1;
    float ka = 0.0125F, diff_a = 0.125F, diff_b = 0.03125F;                  // Turing.
    float feed = 0.037F, kill = 0.060F, diff_u = 0.12F, diff_v = 0.06F;      // Gray-Scott.
    float p1 = 0.04F, p2 = 0.06F, p3 = 0.04F, diff1 = 0.04F, diff2 = 0.06F;  // Stripes.
    float gamma = 0.5F, mixing_speed = 0.02F;                                // Cahn-Hilliard.
    float chi = 5.0F, spread = 10.0F, swarm_speed = 0.02F;                   // Chemotaxis.
    // Tensor, for a1 = 1, a2 = 0.3 and θ = 0.6.
    float a11 = 0.709873F, a12 = 0.424078F, a22 = 0.380127F;
    float tensor_speed = 0.1F;                                         // Tensor.
    float diffusion = 1, wall_speed = 0.1F;                            // Allen-Cahn.
    float growth = 1, defeat = 1, mobility = 0.5F, game_speed = 0.1F;  // Rock, scissors, paper.
    float edge = 0.08F, cleaning_speed = 0.15F;                        // Perona-Malik.
    float above = 0.3F, kc2 = 0.49F, peaks = 0, roll_speed = 0.02F;    // Swift-Hohenberg.
};

/// Takes one step of a system on a periodic grid, and fills the halo of the new fields.
using StraightStep = void (*)(const StraightFields&, const StraightConstants&);

struct StraightSteps {
    StraightStep turing, gray_scott, stripes, cahn_hilliard, chemotaxis, tensor, allen_cahn,
        rock_scissors_paper, perona_malik, swift_hohenberg;
    StraightStep turing_in_space, gray_scott_in_space;
    StraightStep turing_without_mask;
};

StraightSteps straight_contracted();  ///< -O3 -march=native -ffp-contract=fast, g++'s default.
/// The flags of straight_contracted() and -mprefer-vector-width=512.
StraightSteps straight_wide();
/// -O3 -march=native -ffp-contract=off, which rounds as Cascade does.
StraightSteps straight_strict();

}  // namespace cascade::bench
