// The rounds of local operations by Botsch and Kobbelt.
#include "mesh/isotropic_remesh.h"

#include "mesh/collapse_edges.h"
#include "mesh/normals.h"

#include <array>
#include <cmath>

namespace cascade {

namespace {

/// The longest edge, as a multiple of the target edge length.
constexpr double longest_edge_part = 4.0 / 3;
/// For each round, the length below which edges are collapsed, as a multiple of the target edge
/// length.
constexpr std::array shortest = {0.3, 0.5, 0.65, 0.8, 0.8, 0.0, 0.0, 0.0};
constexpr int most_flip_passes = 6;
constexpr double smoothing = 0.6;
constexpr double angle_tolerance = 1e-6;  ///< The tolerance for sums of two angles.
constexpr double flattest_fold = 0.7;     ///< The smallest cosine at an edge that may be flipped.

/// The cosine and the sine of the angle opposite a half-edge, each multiplied by the lengths of the
/// angle's two sides.
struct FacingAngle {
    double cosine = 0, sine = 0;
    double size() const { return std::sqrt(cosine * cosine + sine * sine); }
};
FacingAngle facing_angle(const HalfEdges& mesh, HalfedgeHandle h) {
    const Vector3d apex = position(mesh, mesh.opposite_vh(h));
    const Vector3d a = position(mesh, mesh.from_vertex_handle(h)) - apex;
    const Vector3d b = position(mesh, mesh.to_vertex_handle(h)) - apex;
    return {dot(a, b), length(cross(a, b))};
}

/// Whether two angles sum to at most 180°, by the sine of their sum.
bool is_delaunay(FacingAngle a, FacingAngle b) {
    const double sine = a.cosine * b.sine + a.sine * b.cosine;
    return sine >= 0 || sine >= -angle_tolerance * a.size() * b.size();
}

Vector3d double_area_normal(Vector3d a, Vector3d b, Vector3d c) { return cross(b - a, c - a); }

/// Whether a flip of the edge improves the angles without changing the shape of the surface.
bool wants_flip(const HalfEdges& mesh, EdgeHandle e) {
    if (mesh.is_boundary(e)) return false;
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0), other = mesh.halfedge_handle(e, 1);
    if (is_delaunay(facing_angle(mesh, h), facing_angle(mesh, other))) return false;
    const VertexHandle from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
    const Vector3d a = position(mesh, from), b = position(mesh, to);
    const Vector3d c = position(mesh, mesh.opposite_vh(h)),
                   d = position(mesh, mesh.opposite_vh(other));
    const Vector3d one = double_area_normal(a, b, c), two = double_area_normal(b, a, d);
    if (dot(one, two) < flattest_fold * length(one) * length(two)) return false;
    if (dot(double_area_normal(c, d, b), one + two) <= 0) return false;
    if (dot(double_area_normal(d, c, a), one + two) <= 0) return false;
    return mesh.valence(from) > 3 && mesh.valence(to) > 3 && mesh.is_flip_ok(e);
}

/// Flips edges until the two angles opposite each edge sum to at most 180°.
void flip_edges(HalfEdges& mesh) {
    std::vector<EdgeHandle> suspects, next;
    for (const EdgeHandle e : mesh.edges()) suspects.push_back(e);
    for (int pass = 0; pass < most_flip_passes && !suspects.empty(); ++pass) {
        for (const EdgeHandle e : suspects) {
            if (!wants_flip(mesh, e)) continue;
            mesh.flip(e);
            for (const HalfedgeHandle h :
                 {mesh.halfedge_handle(e, 0), mesh.halfedge_handle(e, 1)}) {
                next.push_back(mesh.edge_handle(mesh.next_halfedge_handle(h)));
                next.push_back(mesh.edge_handle(mesh.prev_halfedge_handle(h)));
            }
        }
        suspects.swap(next);
        next.clear();
    }
}

/// The area-weighted centroid of the triangles around each point, projected to the tangent plane.
std::vector<Vector3d> spread(const SurfaceMesh& mesh, std::span<const Vector3d> normals) {
    std::vector<Vector3d> sums(mesh.points.size());
    std::vector<double> areas(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const double area = mesh.area(t);
        const Vector3d middle =
            (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) * (area / 3);
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

/// Moves the points, except where a move would turn a triangle over.
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

Result<void> isotropic_remesh(SurfaceMesh& mesh, double edge, const BringBack& bring_back,
                              const std::atomic<bool>& cancel) {
    for (const double short_edge : shortest) {
        if (cancel) return {};
        Result<HalfEdges> edited = half_edges(mesh);
        if (!edited) return tl::unexpected(edited.error());
        if (short_edge > 0) collapse_edges(*edited, short_edge * edge, longest_edge_part * edge);
        flip_edges(*edited);
        mesh = surface_mesh(*edited);
        const std::vector<Vector3d> normals = point_normals(mesh);
        std::vector<Vector3d> places = spread(mesh, normals);
        if (Result<void> back = bring_back(places, normals); !back) return back;
        move_points(mesh, std::move(places));
    }
    return {};
}

}  // namespace cascade
