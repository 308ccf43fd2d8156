// Random places on a surface with uniform density: G. Turk, "Texturing Surfaces Using
// Reaction-Diffusion" (thesis, 1992), section 4.3.1.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <vector>

namespace cascade {

/// The weights of a random place in a triangle, from two random numbers in [0, 1] (G. Turk,
/// "Generating random points in triangles", Graphics Gems, 1990).
std::array<double, 3> place_in_triangle(double s, double t);

/// Random places, in numbers proportional to area, with at least one in each component of the
/// surface if there are as many places as components. Each component is divided into strips of
/// equal area, one for each of its places, in the order of its triangles along a Morton curve, so
/// that places with near indices are near each other. Components share places by
/// `component_areas`, or by their own if it is empty. A pure function of its arguments.
std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed,
                                  const std::vector<double>& component_areas = {});

}  // namespace cascade
