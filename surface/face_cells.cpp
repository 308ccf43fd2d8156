// The triangles of one polygon form a cell, with the polygon's edges as Voronoi edges. The distance
// of two cells is the sum of the heights of their centres above their edge.
#include "surface/face_cells.h"

#include "surface/voronoi_edge_list.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace cascade {

namespace {

/// The smallest weight of a corner in a triangle's centre; in the centroid it is 1/3.
constexpr double least_weight = 1.0 / 9;

/// Sums over a face.
struct Face {
    std::uint32_t triangles = 0;
    double area = 0;
    Vector3d moment;                                           ///< Area times centroid.
    double nearest = std::numeric_limits<double>::infinity();  ///< Squared, to the centroid.
};

/// The place of a triangle nearest to a point, or approximately so if that is at its border.
SurfacePlace place_near(const SurfaceMesh& mesh, std::uint32_t t, Vector3d point) {
    const Vector3d origin = mesh.corner(t, 0);
    const Vector3d x = unit(mesh.corner(t, 1) - origin);
    const Vector3d y = cross(unit(mesh.double_area_normal(t)), x);
    const Vector3d from = point - origin;
    return {t, weights_at(own_frame(mesh, t), {dot(from, x), dot(from, y)})};
}

/// The circumcentre of a triangle, moved inside if it is near an edge or outside.
SurfacePlace middle_of(const SurfaceMesh& mesh, std::uint32_t t) {
    // Barycentric weights of the circumcentre are proportional to the sine of twice the angle.
    std::array<double, 3> weights;
    double sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Vector3d a = mesh.corner(t, corner_after(k)) - mesh.corner(t, k);
        const Vector3d b = mesh.corner(t, corner_before(k)) - mesh.corner(t, k);
        const double size = length(a) * length(b);
        weights[k] = size > 0 ? std::max(0.0, length(cross(a, b)) / size * (dot(a, b) / size)) : 0;
        sum += weights[k];
    }
    double total = 0;
    for (double& weight : weights)
        total += weight = std::max(sum > 0 ? weight / sum : 0, least_weight);
    for (double& weight : weights) weight /= total;
    return {t, weights};
}

/// The distance of a point from the line of an edge.
double height_above(const SurfaceMesh& mesh, TriangleEdge edge, Vector3d point) {
    const Vector3d start = mesh.corner(edge.triangle, edge.edge);
    const Vector3d along = mesh.corner(edge.triangle, corner_after(edge.edge)) - start;
    return length(cross(along, point - start)) / length(along);
}

}  // namespace

std::vector<std::uint32_t> cells_of_triangles(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> cells;
    cells.reserve(mesh.triangles.size());
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;  // Of faces; only looked up.
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t face = mesh.faces.empty() ? t : mesh.faces[t];
        const auto next = static_cast<std::uint32_t>(numbers.size());
        cells.push_back(numbers.try_emplace(face, next).first->second);
    }
    return cells;
}

SurfaceCells face_cells(const SurfaceMesh& mesh) {
    const std::vector<std::uint32_t> cell_of = cells_of_triangles(mesh);
    const std::size_t count =
        cell_of.empty() ? 0 : *std::max_element(cell_of.begin(), cell_of.end()) + std::size_t{1};
    std::vector<Face> faces(count);
    for (std::uint32_t t = 0; t < cell_of.size(); ++t) {
        Face& face = faces[cell_of[t]];
        const double area = mesh.area(t);
        ++face.triangles;
        face.area += area;
        face.moment = face.moment + mesh.centroid(t) * area;
    }
    SurfaceCells cells;
    cells.places.resize(count);
    for (std::uint32_t t = 0; t < cell_of.size(); ++t) {
        Face& face = faces[cell_of[t]];
        const Vector3d centroid = face.moment * (1 / face.area);
        const SurfacePlace place =
            face.triangles == 1 ? middle_of(mesh, t) : place_near(mesh, t, centroid);
        const Vector3d apart = position_of(mesh, place) - centroid;
        const bool is_first = face.nearest == std::numeric_limits<double>::infinity();
        if (!is_first && !(dot(apart, apart) < face.nearest)) continue;
        face.nearest = dot(apart, apart);
        cells.places[cell_of[t]] = place;
    }
    for (const Face& face : faces) cells.areas.push_back(face.area);

    // The centroid of a concave polygon may lie on the line of an edge, hence the lower bound.
    const auto height = [&](TriangleEdge edge) {
        const Vector3d middle = position_of(mesh, cells.places[cell_of[edge.triangle]]);
        const Vector3d least = position_of(mesh, middle_of(mesh, edge.triangle));
        return std::max(height_above(mesh, edge, middle),
                        least_weight * height_above(mesh, edge, least));
    };
    VoronoiEdgeList edges;
    for (std::uint32_t t = 0; t < cell_of.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists() || std::tie(t, k) > std::tie(other.triangle, other.edge)) continue;
            const double size = length(mesh.corner(t, corner_after(k)) - mesh.corner(t, k));
            edges.add(cell_of[t], cell_of[other.triangle], size, height({t, k}) + height(other));
        }
    }
    edges.put_into(cells, count);
    return cells;
}

}  // namespace cascade
