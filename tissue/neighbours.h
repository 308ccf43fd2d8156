// The neighbours of each cell: all cells that it may touch or sense until the next rebuild.
//
// A list may hold pairs that do not touch. They contribute exactly +0 to every sum, so no result
// depends on when lists are rebuilt.
#pragma once

#include "core/links.h"
#include "core/parallel.h"
#include "core/result.h"
#include "core/vector3.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The distance of neighbours.
struct NeighbourRule {
    double reach = 1.2;  ///< Cells touch at less than this multiple of the sum of their radii.
    double near = 0;     ///< Cells nearer than this are neighbours, too.
    /// By axis: the period of the tissue, or 0 if it does not repeat. The nearest image counts.
    std::array<double, 3> period{};
    double mean_radius = 0;  ///< Over all cells. Sets the scale for very small ones.
};

/// How far each cell may go, in script lengths, before a list built with this `skin` can miss a
/// pair: `skin` times its radius, or times half the distance `near` or a quarter of the mean radius
/// if that is larger.
inline double slack_of(const NeighbourRule& rule, double skin, double radius) {
    return skin * std::max({radius, rule.near / 2, rule.mean_radius / 4});
}

/// The cells for a search, in the order of memory.
struct CellPlaces {
    std::span<const Vector3d> places;
    std::span<const double> radii;         ///< At least 0.
    std::span<const std::uint32_t> ranks;  ///< Their order by number: 0, 1, …
    std::span<const float> skins = {};     ///< By cell. Empty: the search's.
};

/// The lists of all cells.
struct NeighbourLists {
    std::vector<std::size_t> ends;          ///< Cell k's neighbours end before ends[k].
    std::vector<std::uint32_t> neighbours;  ///< Cells, in ascending order of their numbers.
    /// The number of links between cells too far apart in memory for caches.
    std::size_t far_links = 0;
};

/// Finds all pairs nearer than the rule's distance plus the slack of both, with a grid for each
/// octave of radii, so that few big cells among many small ones cost little. Positions and radii
/// must be finite. Takes O(cells + links). The same on any number of threads. Fails if there would
/// be more than `most_links`, usually before allocating them. Throws std::bad_alloc.
Result<NeighbourLists> find_neighbours(const CellPlaces& cells, const NeighbourRule& rule,
                                       double skin, double most_links, Team& team);

/// The cells in the order of a Morton curve through boxes with a few cells each, so that neighbours
/// are near each other in memory. Cells of one box are sorted by rank.
std::vector<std::uint32_t> order_along_curve(const CellPlaces& cells);

}  // namespace cascade
