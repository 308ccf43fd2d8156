// From the polygons of a file to a surface on which patterns can grow.
#pragma once

#include "core/result.h"
#include "mesh/polygon_soup.h"
#include "mesh/surface_mesh.h"

#include <string>
#include <vector>

namespace cascade {

struct MadeMesh {
    SurfaceMesh mesh;
    std::vector<std::string> repairs;  ///< What was done to the model, a sentence each.
};

/// Cuts polygons into triangles and repairs what can be repaired without guessing:
///
/// - points in the same place are joined, points that no face uses are left out;
/// - faces of fewer than three different corners and faces that are there twice are left out;
/// - where more than two faces meet at an edge, those that continue each other stay together and
///   the others end there; where only a point holds parts together it is doubled;
/// - faces are turned to agree with their neighbours, closed components outwards; a surface with
/// one
///   side only is cut open;
/// - a triangle without area is merged with its neighbour by flipping its longest edge.
///
/// Fails on coordinates that are not finite or out of 10⁻⁷⁰ … 10⁷⁰ in size, on a polygon too
/// intricate to cut, and where no area is left. Throws std::bad_alloc.
Result<MadeMesh> make_mesh(PolygonSoup soup);

}  // namespace cascade
