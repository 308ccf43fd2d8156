// Makes a manifold surface from the polygons of a file.
#pragma once

#include "core/result.h"
#include "mesh/polygon_soup.h"
#include "mesh/surface_mesh.h"

#include <string>
#include <vector>

namespace cascade {

struct MadeMesh {
    SurfaceMesh mesh;
    std::vector<std::string> repairs;  ///< A sentence for each repair.
};

/// Triangulates polygons and makes all repairs that need no guesses:
///
/// - merges points at the same position, removes unused points,
/// - removes faces with fewer than three different corners and duplicate faces,
/// - where more than two faces meet at an edge, connects the faces that continue each other and
///   gives the others a boundary,
/// - where separate parts touch at a point, gives each part its own copy of the point,
/// - orients faces consistently, closed components outwards; cuts one-sided surfaces open,
/// - merges a triangle without area with its neighbour by flipping its longest edge.
///
/// Fails if coordinates are not finite or their largest magnitude is outside 10⁻⁷⁰ … 10⁷⁰, on a
/// polygon too complex to triangulate, and if no area is left. Throws std::bad_alloc.
Result<MadeMesh> make_mesh(PolygonSoup soup);

}  // namespace cascade
