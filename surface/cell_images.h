// The positions of cells in the planes of triangles into which the surface is unfolded.
#pragma once

#include "core/parallel.h"
#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The index of a triangle's longest edge.
std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The triangle with the start of its longest edge at the origin and that edge along the x axis.
FlatTriangle longest_edge_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The position of a cell in the plane of a triangle (longest_edge_frame), in units of the radius,
/// with the surface between them unfolded. Around a corner of a curved surface, several unfoldings
/// lead to a triangle, so each edge has its own position, which both triangles at an edge share.
struct CellImage {
    struct Point {
        float x = 0, y = 0;
    };
    std::uint32_t cell = 0;
    std::uint32_t triangle = 0;
    std::array<Point, 3> from_edges;
};

/// The images of all places in all triangles reached within `radius` of them, along the surface and
/// in space, in the order of places. An edge out of reach has the image of one that is reached,
/// from which the place is farther than the radius. The same on any number of threads.
std::vector<CellImage> cell_images(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                                   double radius, Team& team);

}  // namespace cascade
