// Relaxation: positions repel each other until they are uniformly spread (G. Turk, "Texturing
// Surfaces Using Reaction-Diffusion", thesis, 1992, section 4.3.2).
#pragma once

#include "core/parallel.h"
#include "surface/anisotropy.h"

#include <atomic>
#include <functional>
#include <vector>

namespace cascade {

/// The repulsion radius of `count` positions on a surface: 2 √(area / count).
double repulsion_radius(double area, std::size_t count);

/// The default number of rounds. Uniformity is measured as the standard deviation, over all
/// positions, of the distance to the nearest other position, divided by the mean of that distance.
/// For 8 000 positions on a closed model it is 0.45 for scattered positions and 0.18, 0.09, 0.07,
/// 0.06 and 0.05 after 1, 4, 8, 20 and 40 rounds. It never falls below 0.04. For comparison: it is
/// 0.52 for independent positions, and 0.06 after 40 rounds of Lloyd's method on a plane.
inline constexpr int relaxing_rounds = 40;

/// Moves all positions at once, `rounds` times, each by 0.15 (r − d) away from every other position
/// at a distance d < r. Positions stay on the surface and stop at a boundary. With an anisotropy,
/// distances are in the metric at the pushed position. The result is the same with any number of
/// threads. Returns early with valid positions when `cancel` becomes true. Reports to `progress`,
/// unless it is empty, the completed part of the rounds, 0 … 1. Needs about 600 bytes per position.
///
/// The surroundings of a position are unfolded once for several rounds. Until the next unfolding,
/// relative positions are approximated as on a plane, from the straight steps of positions since
/// the last one. So each position needs a list of neighbours that reaches farther than the force.
/// Such lists are due to L. Verlet ("Computer 'Experiments' on Classical Fluids", Physical Review
/// 159, 1967).
void relax(const SurfaceMesh& mesh, std::vector<SurfacePlace>& places, int rounds, Team& team,
           const std::atomic<bool>& cancel, const Anisotropy* anisotropy = nullptr,
           const std::function<void(double)>& progress = {});

}  // namespace cascade
