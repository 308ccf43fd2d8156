// Construction of a manifold surface from the polygons of a file.
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
/// - points at the same position are merged, unused points are removed;
/// - faces with fewer than three different corners and duplicate faces are removed;
/// - where more than two faces meet at an edge, those that continue each other stay connected and
///   the others get a boundary; a point that alone connects several parts is duplicated;
/// - faces are oriented consistently, closed components outwards; one-sided surfaces are cut open;
/// - a triangle without area is merged with its neighbour by flipping its longest edge.
///
/// Fails if coordinates are not finite or their largest magnitude is outside of 10⁻⁷⁰ … 10⁷⁰, on a
/// polygon too complex to triangulate, and if no area is left. Throws std::bad_alloc.
Result<MadeMesh> make_mesh(PolygonSoup soup);

}  // namespace cascade
