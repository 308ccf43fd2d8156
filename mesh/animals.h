// Animals made for this project, on which patterns grow. They look along +z, and y is up. The
// surface of each animal is one component with the topology of a sphere.
#pragma once

#include "mesh/limbs.h"

namespace cascade {

struct Animal {
    LimbBody body;
    double edge = 0;  ///< Length of the triangles' edges, short enough for ears, fins and tail.
};

// Lengths are in metres, except for the creature, an imaginary animal whose unit of length has no
// meaning.

/// A young animal with four legs, a long tail and round ears, 1.5 high.
Animal creature();
/// A walking leopard, 0.7 high at its shoulders, with a tail as long as its trunk.
Animal leopard();
/// A giraffe, 4.8 high with its horns.
Animal giraffe();
/// A zebra with a mane, 1.3 high at its shoulders.
Animal zebra();
/// A reef fish, 0.43 long, with a high body. The fish floats: its lowest fin is at y = 0.
Animal fish();
/// A sitting frog, 0.1 long.
Animal frog();

}  // namespace cascade
