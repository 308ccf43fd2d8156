// Where the cells of a surface are seen from its triangles, when the surface is unfolded.
#pragma once

#include "core/parallel.h"
#include "surface/flat.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A triangle's longest edge.
std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The triangle with the start of its longest edge at the origin and that edge along the x axis.
FlatTriangle longest_edge_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

/// A place as it lies in the plane of a triangle (longest_edge_frame) into which what is between
/// them is unfolded, in units of the radius.
struct CellImage {
    std::uint32_t cell = 0;
    std::uint32_t triangle = 0;
    float x = 0, y = 0;
};

/// The images of all places on all triangles within `radius` of them along the surface, by the
/// numbers of the places. Around a corner at which the surface is curved a triangle is reached in more
/// than one way; it has each image that is the nearest for some of it. What lies behind a corner
/// of a saddle, where no straight line leads, gets the image of its neighbours. So the distance of a
/// place from its nearest image is that along the surface but for some hundredths of the radius,
/// and nearly continuous. The same on any number of threads.
std::vector<CellImage> cell_images(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                                   double radius, Team& team);

}  // namespace cascade
