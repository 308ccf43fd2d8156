// Areas and cotangents of the intrinsic Delaunay triangulation (mesh/intrinsic_delaunay), which
// make all weights of Voronoi edges non-negative.
#include "surface/vertex_cells.h"

#include "mesh/intrinsic_delaunay.h"
#include "surface/voronoi_edge_list.h"

#include <tuple>

namespace cascade {

namespace {

/// Smaller weights, such as those of the diagonals of squares, are rounding errors of zero.
constexpr double rounding_of_weights = 1e-9;

/// Distributes the area of a triangle to its corners: by Voronoi regions, or, if an angle is
/// obtuse, one half to it and a quarter each to the others (Meyer et al., figure 4).
void share_area(const IntrinsicMesh& mesh, std::uint32_t t, std::vector<double>& areas) {
    const double area = mesh.area(t);
    std::array<double, 3> cotangents;
    for (std::uint32_t k = 0; k < 3; ++k) cotangents[k] = mesh.cotangent({t, k});
    const auto& corners = mesh.triangles[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (cotangents[k] >= 0) continue;
        const std::uint32_t obtuse = corner_before(k);  // The corner opposite edge k.
        for (std::uint32_t j = 0; j < 3; ++j)
            areas[corners[j]] += area * (j == obtuse ? 0.5 : 0.25);
        return;
    }
    std::array<double, 3> parts;  // Of edge k: a² cot / 8 for each of its ends.
    double sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
        parts[k] = mesh.lengths[t][k] * mesh.lengths[t][k] * cotangents[k];
        sum += parts[k];
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
        const double part = sum > 0 ? parts[k] / sum : 1.0 / 3;
        areas[corners[k]] += area * part / 2;
        areas[corners[corner_after(k)]] += area * part / 2;
    }
}

}  // namespace

SurfaceCells vertex_cells(const SurfaceMesh& mesh) {
    const IntrinsicMesh flipped = intrinsic_delaunay(mesh);
    SurfaceCells cells;
    cells.places.resize(mesh.points.size());
    cells.areas.assign(mesh.points.size(), 0);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            SurfacePlace place = {t, {0, 0, 0}};
            place.weights[k] = 1;
            cells.places[mesh.triangles[t][k]] = place;
        }
    }
    VoronoiEdgeList edges;
    for (std::uint32_t t = 0; t < flipped.triangles.size(); ++t) {
        share_area(flipped, t, cells.areas);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = flipped.across[t][k];
            if (other.exists() && std::tie(t, k) > std::tie(other.triangle, other.edge)) continue;
            const double cotangents =
                flipped.cotangent({t, k}) + (other.exists() ? flipped.cotangent(other) : 0);
            if (cotangents / 2 < rounding_of_weights) continue;
            const double distance = flipped.lengths[t][k];
            edges.add(flipped.triangles[t][k], flipped.triangles[t][corner_after(k)],
                      cotangents / 2 * distance, distance);
        }
    }
    edges.put_into(cells, mesh.points.size());
    return cells;
}

}  // namespace cascade
