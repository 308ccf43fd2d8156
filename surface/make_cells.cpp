// Cells around points and cells of faces follow the mesh. Cells around spread positions are Voronoi
// cells. The options are checked first.
#include "surface/make_cells.h"

#include "core/counted.h"
#include "core/with_commas.h"
#include "mesh/intrinsic_delaunay.h"
#include "surface/cells_by_copy.h"
#include "surface/scatter.h"
#include "surface/voronoi_cells.h"
#include "surface/voronoi_edge_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace cascade {

namespace {

/// Weights below this count as 0. The weights of diagonals of squares, for example, differ from 0
/// only by rounding.
constexpr double rounding_of_weights = 1e-9;

/// Distributes the area of a triangle to its corners by Voronoi regions. If an angle is obtuse, its
/// corner gets half of the area and each other corner a quarter (Meyer et al., figure 4).
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
    std::array<double, 3>
        parts;  // For edge k: a² cot, which is 8 times the area that each end of the edge gets.
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

/// The smallest weight that a corner may have at a triangle's centre. At the centroid, each weight
/// is 1/3.
constexpr double least_weight = 1.0 / 9;

/// Sums over the triangles of a face.
struct Face {
    std::uint32_t triangles = 0;
    double area = 0;
    Vector3d moment;  ///< The sum of area times centroid.
    /// The squared distance of the nearest triangle from the centroid.
    double nearest = std::numeric_limits<double>::infinity();
};

/// The position on a triangle nearest to a point. A position at the triangle's border is
/// approximate.
SurfacePlace place_near(const SurfaceMesh& mesh, std::uint32_t t, Vector3d point) {
    const Vector3d origin = mesh.corner(t, 0);
    const Vector3d x = unit(mesh.corner(t, 1) - origin);
    const Vector3d y = cross(unit(mesh.double_area_normal(t)), x);
    const Vector3d from = point - origin;
    return {t, weights_at(own_frame(mesh, t), {dot(from, x), dot(from, y)})};
}

/// The circumcentre of a triangle, moved inside if it is near an edge or outside.
SurfacePlace middle_of(const SurfaceMesh& mesh, std::uint32_t t) {
    // Barycentric weights of the circumcentre are proportional to the sines of twice the angles.
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

constexpr std::uint64_t most_cells = 0xfffffffe;

Result<void> check_anisotropy(const SurfaceMesh& mesh, const Anisotropy& anisotropy) {
    const std::size_t count = mesh.triangles.size();
    if (anisotropy.direction.size() != count || anisotropy.ratio.size() != count) {
        return failure(
            fmt::format("a surface of {} triangles is stretched by {} directions and {} "
                        "ratios",
                        count, anisotropy.direction.size(), anisotropy.ratio.size()));
    }
    for (std::size_t t = 0; t < count; ++t) {
        const double ratio = anisotropy.ratio[t];
        if (!(ratio >= 1 && ratio <= Anisotropy::largest_ratio)) {
            return failure(fmt::format("the cells of triangle {} should be {} times as long as "
                                       "wide",
                                       t, ratio),
                           fmt::format("the ratio must be from 1 to {}",
                                       Anisotropy::largest_ratio));
        }
        if (!std::isfinite(dot(anisotropy.direction[t], anisotropy.direction[t]))) {
            return failure(fmt::format("the direction of cells of triangle {} is not finite", t));
        }
    }
    return {};
}

Result<void> check_count(const SurfaceMesh& mesh, std::uint64_t count) {
    if (count < 1 || count > most_cells) {
        return failure(fmt::format("a surface cannot have {} cells", count),
                       fmt::format("the number of cells must be from 1 to {}", most_cells));
    }
    const std::vector<std::uint32_t> components = connected_components(mesh);
    const std::uint64_t needed =
        *std::max_element(components.begin(), components.end()) + std::uint64_t{1};
    if (count >= needed) return {};
    return failure(fmt::format("{} cannot cover a surface of {} separate parts",
                               counted(count, "cell"), with_commas(needed)),
                   fmt::format("use {} cells or more, or join the parts", with_commas(needed)));
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

std::vector<std::uint32_t> cells_of_triangles(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> cells;
    cells.reserve(mesh.triangles.size());
    // The cell of each face. Used for look-up only.
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
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

    // The centroid of a concave polygon may be on the line of an edge, so the height has a lower
    // bound.
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

std::uint64_t count_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    switch (options.kind) {
        case CellKind::places: return options.count;
        case CellKind::vertices: return mesh.points.size();
        case CellKind::faces: break;
    }
    std::vector<std::uint32_t> faces = mesh.faces;
    std::sort(faces.begin(), faces.end());
    const auto end = std::unique(faces.begin(), faces.end());
    return faces.empty() ? mesh.triangles.size() : static_cast<std::uint64_t>(end - faces.begin());
}

double memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const auto count = static_cast<double>(count_cells(mesh, options));
    return options.kind == CellKind::places ? 900 * count + 300 * triangles : 400 * triangles;
}

Result<void> check_cells(const SurfaceMesh& mesh, const CellOptions& options) {
    if (mesh.triangles.empty()) return failure("the surface has no triangles");
    if (options.kind != CellKind::places) return {};
    if (Result<void> fine = check_count(mesh, options.count); !fine) return fine;
    return options.anisotropy ? check_anisotropy(mesh, *options.anisotropy) : Result<void>();
}

Result<SurfaceCells> make_cells(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                const std::atomic<bool>& cancel) {
    if (Result<void> fine = check_cells(mesh, options); !fine) return tl::unexpected(fine.error());
    if (options.kind == CellKind::faces) return face_cells(mesh);
    if (options.kind == CellKind::vertices) return vertex_cells(mesh);
    // If a copy of the surface cannot be made, cells may still be made on the surface itself.
    if (is_fine(mesh, options)) {
        Result<SurfaceCells> cells = cells_by_copy(mesh, options, team, cancel);
        if (cells) return cells;
    }
    std::vector<SurfacePlace> places =
        scatter(mesh, static_cast<std::size_t>(options.count), options.seed);
    relax(mesh, places, options.rounds, team, cancel, options.anisotropy, options.progress);
    return voronoi_cells(mesh, std::move(places), team, cancel, options.anisotropy);
}

}  // namespace cascade
