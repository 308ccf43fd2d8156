// Charts, the flattened parts of a surface, and the seams between them.
#pragma once

#include "core/vector2.h"
#include "mesh/flat.h"
#include "mesh/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cascade {

/// For each edge of each triangle, whether the surface is cut there. Both sides of an edge have the
/// same value. Boundaries count as cuts.
using Seams = std::vector<std::array<bool, 3>>;

/// Triangles connected over edges without a seam. A point of the surface that seams divide has
/// several positions in the chart.
struct Chart {
    std::vector<std::uint32_t> triangles;  ///< Indices of triangles of the surface.
    /// The corners of each triangle, as indices of positions.
    std::vector<std::array<std::uint32_t, 3>> corners;
    std::vector<Vector2d> places;  ///< Positions in the plane.
    /// For each triangle, the direction (of length 1) that the x axis of the triangle's own frame
    /// (shape_of) has in the plane.
    std::vector<Vector2d> turns;

    /// Rotates all positions about the origin.
    void turn(Vector2d by) {
        for (Vector2d& place : places) place = product(by, place);
    }
    FlatTriangle flat(std::size_t number) const {
        const auto& [a, b, c] = corners[number];
        return {places[a], places[b], places[c]};
    }
};

/// A triangle laid flat by own_frame(). Its edges and heights are increased to at least 10⁻⁴ of its
/// longest edge, so that a triangle without area can be laid flat, too.
FlatTriangle shape_of(const SurfaceMesh& mesh, std::uint32_t triangle);

/// Twice the area, positive if the corners are counterclockwise.
inline double double_area(const FlatTriangle& flat) {
    return cross(flat[1] - flat[0], flat[2] - flat[0]);
}

/// Makes a chart of triangles by joining them at all edges without a seam. Computes no positions.
/// `numbers` is scratch memory with an element for each triangle of the surface. The elements of
/// the chart's triangles are overwritten.
Chart chart_of(const SurfaceMesh& mesh, const Seams& seams, std::vector<std::uint32_t> triangles,
               std::span<std::uint32_t> numbers);

/// The largest and the smallest factor by which a triangle's flat image lengthens a direction, in
/// this order. The smallest is negative if the image is mirrored.
std::array<double, 2> stretches(const FlatTriangle& shape, const FlatTriangle& image);

/// The largest factor by which lengths change, ≥ 1. It is the larger stretch or the reciprocal of
/// the smaller one, whichever is larger. Infinite if the image has no area or is mirrored.
inline double distortion(const std::array<double, 2>& stretches) {
    if (!(stretches[1] > 0)) return std::numeric_limits<double>::infinity();
    return std::max(stretches[0], 1 / stretches[1]);
}

}  // namespace cascade
