#include "mesh/even_triangles.h"

#include "mesh/normals.h"

#include "mesh/collapse_edges.h"
#include "mesh/exchange_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr double longest = 4.0 / 3;  ///< Edges, in units of the one that is wanted.
/// How short an edge must be to go, round by round: the shortest first.
constexpr std::array shortest = {0.3, 0.5, 0.65, 0.8, 0.8, 0.0, 0.0, 0.0};
constexpr int exchange_passes = 3;
constexpr double smoothing = 0.6;
constexpr double flattest_fold = 0.7;  ///< Cosine between triangles whose edge may be exchanged.

/// The angle at corner k.
double angle_at(const SurfaceMesh& mesh, std::uint32_t t, std::uint32_t k) {
    const Vector3d p = mesh.corner(t, k);
    const Vector3d a = mesh.corner(t, (k + 1) % 3) - p, b = mesh.corner(t, (k + 2) % 3) - p;
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Exchanges edges until no two angles that face one sum up to more than half a turn.
class Exchanger {
public:
    explicit Exchanger(SurfaceMesh& mesh) : mesh_(mesh), leaving_(leaving_edges(mesh)) {}

    void run() {
        for (int pass = 0; pass < exchange_passes; ++pass) {
            std::size_t count = 0;
            for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
                for (std::uint32_t k = 0; k < 3; ++k) count += try_edge({t, k});
            }
            if (count == 0) return;
        }
    }

private:
    bool try_edge(TriangleEdge edge) {
        const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
        const double facing = angle_at(mesh_, edge.triangle, (edge.edge + 2) % 3) +
                              angle_at(mesh_, other.triangle, (other.edge + 2) % 3);
        if (facing <= std::numbers::pi + 1e-6) return false;
        const auto corner = [&](TriangleEdge e, std::uint32_t k) {
            return mesh_.triangles[e.triangle][(e.edge + k) % 3];
        };
        const std::uint32_t a = corner(edge, 0), b = corner(edge, 1), c = corner(edge, 2),
                            d = corner(other, 2);
        const Vector3d one = mesh_.double_area_normal(edge.triangle);
        const Vector3d two = mesh_.double_area_normal(other.triangle);
        if (dot(one, two) < flattest_fold * length(one) * length(two)) return false;
        const auto faces_out = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
            const Vector3d from = mesh_.points[p];
            return dot(cross(mesh_.points[q] - from, mesh_.points[r] - from), one + two) > 0;
        };
        if (!faces_out(c, d, b) || !faces_out(d, c, a)) return false;
        if (!is_spare(a) || !is_spare(b) || are_neighbours(c, d)) return false;
        exchange_edge(mesh_, edge);
        leaving_[c] = {edge.triangle, 0};
        leaving_[d] = {edge.triangle, 1};
        leaving_[b] = {edge.triangle, 2};
        leaving_[a] = {other.triangle, 2};
        return true;
    }

    /// Can a point lose an edge?
    bool is_spare(std::uint32_t point) const {
        int count = 0;
        around_point(mesh_, leaving_[point], [&](TriangleEdge) { ++count; });
        return count > 3;
    }
    bool are_neighbours(std::uint32_t a, std::uint32_t b) const {
        bool found = false;
        around_point(mesh_, leaving_[a], [&](TriangleEdge e) {
            found = found || mesh_.triangles[e.triangle][(e.edge + 1) % 3] == b;
        });
        return found;
    }

    SurfaceMesh& mesh_;
    std::vector<TriangleEdge> leaving_;
};

/// Where points would lie in the middle of the triangles around them, each of which counts as much as
/// its area, but only along the surface.
std::vector<Vector3d> spread(const SurfaceMesh& mesh, std::span<const Vector3d> normals) {
    std::vector<Vector3d> sums(mesh.points.size());
    std::vector<double> areas(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const double area = mesh.area(t);
        const Vector3d middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) * (area / 3);
        for (const std::uint32_t point : mesh.triangles[t]) {
            sums[point] = sums[point] + middle;
            areas[point] += area;
        }
    }
    std::vector<Vector3d> places = mesh.points;
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (!(areas[p] > 0)) continue;
        const Vector3d step = sums[p] * (1 / areas[p]) - places[p];
        places[p] = places[p] + (step - normals[p] * dot(step, normals[p])) * smoothing;
    }
    return places;
}

/// Moves the points but for those of triangles that would be turned over.
void move_points(SurfaceMesh& mesh, std::vector<Vector3d> places) {
    for (bool is_fine = false; !is_fine;) {
        is_fine = true;
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto normal = [&](const std::vector<Vector3d>& points) {
                return cross(points[b] - points[a], points[c] - points[a]);
            };
            if (dot(normal(mesh.points), normal(places)) >= 0) continue;
            for (const std::uint32_t point : {a, b, c}) places[point] = mesh.points[point];
            is_fine = false;
        }
    }
    mesh.points = std::move(places);
}

}  // namespace

Result<void> make_even(SurfaceMesh& mesh, double edge, const BringBack& bring_back,
                       const std::atomic<bool>& cancel) {
    for (const double short_edge : shortest) {
        if (cancel) return {};
        if (short_edge > 0) collapse_edges(mesh, short_edge * edge, longest * edge);
        Exchanger(mesh).run();
        const std::vector<Vector3d> normals = point_normals(mesh);
        std::vector<Vector3d> places = spread(mesh, normals);
        if (Result<void> back = bring_back(places, normals); !back) return back;
        move_points(mesh, std::move(places));
    }
    return {};
}

}  // namespace cascade
