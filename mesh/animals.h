// Animals of our own, for patterns to grow on. They look along +z, and y is up. The surface of each
// is one component with the topology of a sphere.
#pragma once

#include "mesh/limbs.h"

namespace cascade {

struct Animal {
    LimbBody body;
    double edge = 0;  ///< Of triangles that are fine enough for its ears, fins and tail.
};

// Lengths are metres, but those of the creature, which is no animal in particular.

/// A young animal with four legs, a long tail and round ears, 1.5 high.
Animal creature();
/// 0.7 high at its shoulders, with a tail as long as its trunk.
Animal leopard();
/// 4.8 high, with its horns.
Animal giraffe();
/// 1.3 high at its shoulders, with a mane.
Animal zebra();
/// A fish of reefs, 0.43 long, with a high body. It floats: its lowest fin is at y = 0.
Animal fish();
/// 0.1 long; it sits.
Animal frog();

}  // namespace cascade
