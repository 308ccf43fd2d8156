// Points spread evenly over a surface: G. Turk, "Texturing Surfaces Using Reaction-Diffusion"
// (thesis, 1992), sections 4.3.1 and 4.3.2.
#pragma once

#include "core/parallel.h"
#include "surface/flat.h"

#include <atomic>
#include <vector>

namespace cascade {

/// The radius of repulsion of n points on a surface of an area: 2 √(area / n).
double repulsion_radius(double area, std::size_t count);

/// Random places, as many on each triangle as its area asks for: the surface is taken as `count` strips of
/// equal area, in order of its triangles, with one place in each. A pure function of its arguments.
std::vector<SurfacePlace> scatter(const SurfaceMesh& mesh, std::size_t count, std::uint32_t seed);

/// Lets the places push each other: each is moved by 0.15 (r − d) away from every other at a
/// distance d < r, all at once, `rounds` times. They stay on the surface; at a boundary they stop. The same
/// places on any number of threads. Returns early when `cancel` becomes true.
void relax(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, int rounds, Team& team,
           const std::atomic<bool>& cancel);

}  // namespace cascade
