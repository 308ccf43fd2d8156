// The neighbours of each cell: all cells that it may touch or sense before the lists are built
// again.
//
// A list may contain cells that do not touch. Such cells contribute exactly +0 to every sum, so no
// result depends on when lists are built.
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

/// Determines which cells are neighbours.
struct NeighbourRule {
    /// Cells are neighbours if their distance is less than this multiple of the sum of their radii.
    double reach = 1.2;
    double near = 0;  ///< Cells at a smaller distance than this are also neighbours.
    /// The period of the tissue along each axis, or 0 if it is not periodic. Distances are measured
    /// to the nearest periodic image.
    std::array<double, 3> period{};
    double mean_radius = 0;  ///< The mean radius of all cells. Sets the scale for very small cells.
};

/// The distance, in script lengths, that each cell may move before a list built with this `skin`
/// can miss a pair: `skin` times the largest of three lengths. These are the cell's radius, half of
/// `near`, and a quarter of the mean radius.
inline double slack_of(const NeighbourRule& rule, double skin, double radius) {
    return skin * std::max({radius, rule.near / 2, rule.mean_radius / 4});
}

/// The cells to search, in the order of memory.
struct CellPlaces {
    std::span<const Vector3d> places;
    std::span<const double> radii;  ///< At least 0.
    /// The rank of each cell: the cell's index, from 0, if all cells are sorted by their numbers.
    std::span<const std::uint32_t> ranks;
    /// The skin of each cell. If empty, all cells have the skin given to the search.
    std::span<const float> skins = {};
};

/// The lists of all cells.
struct NeighbourLists {
    /// The neighbours of cell k end before neighbours[ends[k]].
    std::vector<std::size_t> ends;
    /// The neighbours' indices, in ascending order of the cells' numbers.
    std::vector<std::uint32_t> neighbours;
    /// The number of links between cells that are far apart in memory; see is_far_link().
    std::size_t far_links = 0;
};

/// Finds all pairs nearer than the rule's distance plus the slack of both cells. Uses a grid of
/// boxes for each octave of radii, so that a few large cells among many small cells cost little
/// time. Positions and radii must be finite. Takes O(cells + links). The result is the same with
/// any number of threads. Fails if there would be more than `most_links` links, usually before
/// allocating memory for them. Throws std::bad_alloc.
Result<NeighbourLists> find_neighbours(const CellPlaces& cells, const NeighbourRule& rule,
                                       double skin, double most_links, Team& team);

/// The cells in the order of a Morton curve through boxes with a few cells each, so that neighbours
/// are near each other in memory. Cells of the same box are sorted by rank.
std::vector<std::uint32_t> order_along_curve(const CellPlaces& cells);

}  // namespace cascade
