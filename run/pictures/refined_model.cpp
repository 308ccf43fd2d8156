// Colours are linear between points. The filter of cells is nearly linear over the distance between
// points that is chosen here.
#include "run/pictures/refined_model.h"

#include "export/point_values.h"
#include "mesh/normals.h"
#include "surface/blur_cells.h"

#include <cstddef>
#include <vector>

namespace cascade {

namespace {

/// The distance between points, as a multiple of the distance between cells. The radius of the
/// filter is twice the distance between cells.
constexpr double colour_distance = 0.75;
constexpr std::size_t most_triangles = std::size_t{1} << 23;

}  // namespace

RefinedMesh refined_for_colours(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    return refined(mesh, colour_distance * cell_spacing(cells), most_triangles);
}

RefinedMesh raised_model(RefinedMesh fine, const SurfaceMesh& mesh, const CellFilter& filter,
                         std::span<const float> heights, Team& team) {
    std::vector<Vector3d> normals;
    const std::vector<Vector3d> of_points = point_normals(mesh);
    for (const SurfacePlace& place : fine.places) {
        normals.push_back(normal_at(mesh, of_points, place));
    }
    const Channel channel{"height", {heights.begin(), heights.end()}};
    displace(fine.mesh, normals,
             values_at(fine.places, filter, {&channel, 1}, team).front().values);
    return fine;
}

}  // namespace cascade
