// Scatters random positions over a surface with uniform density: G. Turk, "Texturing Surfaces Using
// Reaction-Diffusion" (thesis, 1992), section 4.3.1.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <vector>

namespace cascade {

/// The weights of a random position in a triangle, from two random numbers in [0, 1] (G. Turk,
/// "Generating random points in triangles", Graphics Gems, 1990).
std::array<double, 3> place_in_triangle(double s, double t);

/// `count` random positions. Their number in each component is proportional to the component's
/// area, but at least one if there are at least as many positions as components. Divides each
/// component into strips of equal area, one for each position, in the order of its triangles along
/// a Morton curve, so that positions with near indices are near each other. If `component_areas` is
/// not empty, it replaces the areas of the components. The result depends only on the arguments.
std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed,
                                  const std::vector<double>& component_areas = {});

}  // namespace cascade
