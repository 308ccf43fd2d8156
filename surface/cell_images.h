// Where the cells of a surface are seen from its triangles, when the surface is unfolded.
#pragma once

#include "core/parallel.h"
#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A triangle's longest edge.
std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The triangle with the start of its longest edge at the origin and that edge along the x axis.
FlatTriangle longest_edge_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

/// A cell as it is seen from a triangle that the surface between them is unfolded into: where its
/// place lies in the plane of longest_edge_frame, in units of the radius. Around a corner at which
/// the surface is curved a triangle is reached in several ways, so each edge has its own, and both
/// triangles at an edge have the same one there.
struct CellImage {
    struct Point {
        float x = 0, y = 0;
    };
    std::uint32_t cell = 0;
    std::uint32_t triangle = 0;
    std::array<Point, 3> from_edges;
};

/// The images of all places on all triangles that are reached within `radius` of them, along the
/// surface and in space, by the numbers of the places. An edge that is not reached has the image of
/// one that is: from there the place is farther than the radius. The same on any number of threads.
std::vector<CellImage> cell_images(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                                   double radius, Team& team);

}  // namespace cascade
