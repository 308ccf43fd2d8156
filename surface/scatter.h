// Random positions on a surface with uniform density: G. Turk, "Texturing Surfaces Using
// Reaction-Diffusion" (thesis, 1992), section 4.3.1.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <vector>

namespace cascade {

/// The weights of a random position in a triangle, from two random numbers in [0, 1] (G. Turk,
/// "Generating random points in triangles", Graphics Gems, 1990).
std::array<double, 3> place_in_triangle(double s, double t);

/// Random positions, in numbers proportional to area, with at least one in each component of the
/// surface if there are as many positions as components. Divides each component into strips of
/// equal area, one for each position, in the order of its triangles along a Morton curve, so that
/// positions with near indices are near each other. Components share positions by
/// `component_areas`, or by their own areas if it is empty. A pure function of its arguments.
std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed,
                                  const std::vector<double>& component_areas = {});

}  // namespace cascade
