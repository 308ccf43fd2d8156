// The part of the public library (include/cascade/cascade.h) that gives the cells and triangles of
// models.
#include "library/pattern_state.h"
#include "mesh/flat.h"
#include "run/domain/model_cells.h"
#include "surface/surface_cells.h"

namespace cascade {
namespace {

void append(std::vector<double>& numbers, Vector3d place) {
    numbers.insert(numbers.end(), {place.x, place.y, place.z});
}

}  // namespace

PatternModel Pattern::model() {
    PatternModel model;
    if (!self_->running()) return model;
    self_->forget_error();
    const auto of = self_->model();
    if (!of) {
        self_->note({"the pattern grows on a grid, not on a model",
                     "the cells of a grid have no triangles"});
        return model;
    }
    const SurfaceMesh& mesh = of->mesh;
    const SurfaceCells& cells = of->spread().cells;
    const ModelBox box(mesh);
    for (const SurfacePlace& place : cells.places) {
        append(model.points, box.in_script(position_of(mesh, place)));
    }
    for (const double area : cells.areas) {
        model.areas.push_back(area / (box.longest * box.longest));
    }
    for (std::uint32_t cell = 0; cell < cells.places.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            if (edge.neighbour < cell) continue;
            model.links.insert(model.links.end(), {cell, edge.neighbour});
            model.weights.push_back(edge.weight());
        }
    }
    for (const Vector3d& point : mesh.points) append(model.vertices, box.in_script(point));
    for (const auto& corners : mesh.triangles) {
        model.triangles.insert(model.triangles.end(), corners.begin(), corners.end());
    }
    return model;
}

}  // namespace cascade
