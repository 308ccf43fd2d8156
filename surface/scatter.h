// Random places on a surface, as dense everywhere: G. Turk, "Texturing Surfaces Using
// Reaction-Diffusion" (thesis, 1992), section 4.3.1.
#pragma once

#include "mesh/flat.h"

#include <vector>

namespace cascade {

/// Random places, as many on each triangle as its area asks for, and at least one on each component
/// of the surface if there are as many places as components: each component is taken as strips of
/// equal area, one for each of its places, in the order of its triangles along G. Morton's curve,
/// so that places with near numbers lie near each other. A pure function of its arguments.
std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed);

}  // namespace cascade
