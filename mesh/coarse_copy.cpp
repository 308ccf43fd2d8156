// Collapses edges shorter than a limit. The limit grows step by step to the target, so that
// triangles stay well shaped at every step.
#include "mesh/coarse_copy.h"

#include "mesh/collapse_edges.h"

#include <cmath>

namespace cascade {

Result<CoarseCopy> coarse_copy(const SurfaceMesh& mesh, double edge) {
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    MergedVertices merged(*edited);
    const double mean_area = mesh.total_area() / static_cast<double>(mesh.triangles.size());
    for (double shortest = 2 * std::sqrt(mean_area); shortest < edge; shortest *= 2) {
        collapse_edges(*edited, shortest, 2 * shortest, &merged);
    }
    collapse_edges(*edited, edge, 2 * edge, &merged);

    CoarseCopy copy;
    std::vector<std::uint32_t> kept, indices(mesh.points.size());
    for (const VertexHandle v : edited->vertices()) {
        indices[number(v)] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(number(v));
    }
    copy.mesh = surface_mesh(*edited, kept);
    copy.merged = merged.left();
    for (std::uint32_t& point : copy.merged) point = indices[point];
    return copy;
}

}  // namespace cascade
