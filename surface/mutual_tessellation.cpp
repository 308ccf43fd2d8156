// Inserts positions one by one, in random rounds along a curve, and flips edges until the new
// triangles within each old triangle are Delaunay. Locates positions by walking over edges.
#include "surface/mutual_tessellation.h"

#include "core/hash.h"
#include "surface/place_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace cascade {

namespace {

/// Interleaves the bits of two numbers. The result is a position on a Morton curve: points that are
/// near each other on the curve are near each other in the plane.
std::uint64_t along_curve(const Steps& steps) {
    std::uint64_t key = 0;
    for (int bit = 24; bit >= 0; --bit) {
        key = key << 2 | static_cast<std::uint64_t>(steps[1] >> bit & 1) << 1 |
              static_cast<std::uint64_t>(steps[2] >> bit & 1);
    }
    return key;
}

/// Orders positions by triangle. Within a triangle, positions are divided at random into rounds,
/// each with twice as many positions as the round before. Each round follows a curve.
std::vector<std::uint32_t> insertion_order(const std::vector<LatticePlace>& places) {
    using Entry = std::tuple<std::uint32_t, int, std::uint64_t, std::uint32_t>;
    std::vector<Entry> entries;
    entries.reserve(places.size());
    for (std::uint32_t k = 0; k < places.size(); ++k) {
        const int round = -std::countr_zero(pcg4d({k, 0, 0, 2})[0]);
        entries.emplace_back(places[k].triangle, round, along_curve(places[k].steps), k);
    }
    std::sort(entries.begin(), entries.end());
    std::vector<std::uint32_t> order;
    for (const Entry& entry : entries) order.push_back(std::get<3>(entry));
    return order;
}

/// Whether d is inside the circle through a, b and c by more than rounding errors.
bool is_in_circle(Vector2d a, Vector2d b, Vector2d c, Vector2d d) {
    a = a - d;
    b = b - d;
    c = c - d;
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const double bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double size = aa * (std::abs(b.x * c.y) + std::abs(b.y * c.x)) +
                        bb * (std::abs(c.x * a.y) + std::abs(c.y * a.x)) +
                        cc * (std::abs(a.x * b.y) + std::abs(a.y * b.x));
    return aa * bc + bb * ca + cc * ab > 1e-14 * size;
}

class Tessellator {
public:
    Tessellator(HalfEdges& mesh, const SurfaceMesh& old, const std::vector<LatticePlace>& places)
        : mesh_(mesh), old_(old), places_(places) {
        mesh.add_property(origin_);
        for (const FaceHandle f : mesh.faces()) origin(f) = static_cast<std::uint32_t>(f.idx());
        made_.point_of_place.resize(places.size());
        take_normals();
    }
    ~Tessellator() { mesh_.remove_property(origin_); }
    Tessellator(const Tessellator&) = delete;
    Tessellator& operator=(const Tessellator&) = delete;

    MutualTessellation tessellate(const std::atomic<bool>& cancel) {
        const std::vector<std::uint32_t> order = insertion_order(places_);
        add_points();
        FaceHandle near;
        for (const std::uint32_t place : order) {
            if (cancel) break;
            if (places_[place].corner() < 3) continue;
            const std::uint32_t triangle = places_[place].triangle;
            if (!near.is_valid() || origin(near) != triangle)
                near = FaceHandle(static_cast<int>(triangle));
            near = insert(made_.point_of_place[place], near);
        }
        return std::move(made_);
    }

private:
    /// The old triangle that contains a face. Splitting a face or an edge copies this value.
    std::uint32_t& origin(FaceHandle f) { return mesh_.property(origin_, f); }
    std::uint32_t origin(FaceHandle f) const { return mesh_.property(origin_, f); }

    /// Sets the area-weighted normals of the old points.
    void take_normals() {
        made_.normals.resize(old_.points.size());
        for (std::size_t t = 0; t < old_.triangles.size(); ++t) {
            for (const std::uint32_t point : old_.triangles[t]) {
                made_.normals[point] = made_.normals[point] + old_.double_area_normal(t);
            }
        }
        for (Vector3d& normal : made_.normals) normal = unit(normal);
    }

    /// Adds points in the order of positions, so that indices do not depend on the order of
    /// insertion.
    void add_points() {
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const LatticePlace& place = places_[k];
            std::uint32_t& point = made_.point_of_place[k];
            if (const std::uint32_t corner = place.corner(); corner < 3) {
                point = old_.triangles[place.triangle][corner];
                continue;
            }
            SurfacePlace rounded{place.triangle, {}};
            for (std::size_t c = 0; c < 3; ++c) {
                rounded.weights[c] = static_cast<double>(place.steps[c]) / lattice_steps;
            }
            const Vector3d at = position_of(old_, rounded);
            point = number(mesh_.add_vertex({at.x, at.y, at.z}));
            place_of_point_.push_back(static_cast<std::uint32_t>(k));
            Vector3d normal = unit(old_.double_area_normal(place.triangle));
            if (const std::uint32_t edge = place.edge(); edge < 3) {
                const TriangleEdge other = old_.across[place.triangle][edge];
                if (other.exists()) normal = normal + unit(old_.double_area_normal(other.triangle));
            }
            made_.normals.push_back(unit(normal));
        }
    }

    /// The position of a point in the old triangle `triangle`, which contains the point, possibly
    /// on a side.
    Steps steps_in(std::uint32_t triangle, VertexHandle v) const {
        const std::uint32_t point = number(v);
        if (point < old_.points.size()) {
            Steps steps{};
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (old_.triangles[triangle][k] == point) steps[k] = lattice_steps;
            }
            return steps;
        }
        const LatticePlace& place = places_[place_of_point_[point - old_.points.size()]];
        if (place.triangle == triangle) return place.steps;
        const std::uint32_t edge = place.edge();
        return steps_across(place.steps, edge, old_.across[place.triangle][edge].edge);
    }

    Vector2d flat(const Steps& steps) const {
        return frame_[1] * (static_cast<double>(steps[1]) / lattice_steps) +
               frame_[2] * (static_cast<double>(steps[2]) / lattice_steps);
    }

    /// The end of a walk to a point: a face that contains the point, and an edge of the face if the
    /// point lies on this edge.
    struct Found {
        FaceHandle face;
        HalfedgeHandle edge;
    };

    /// Walks from face `f` to a point, across edges that have the current face on one side and the
    /// point on the other. If there are several such edges, chooses one at random, so that the walk
    /// cannot cycle: O. Devillers, S. Pion and M. Teillaud, "Walking in a triangulation", 2002.
    Found locate(const Steps& point, FaceHandle f) const {
        for (std::uint32_t step = 0;; ++step) {
            HalfedgeHandle h = mesh_.halfedge_handle(f), on, leave;
            const auto chance = pcg4d({step, static_cast<std::uint32_t>(f.idx()), 0, 3})[0] % 3;
            for (std::uint32_t k = 0; k < chance; ++k) h = mesh_.next_halfedge_handle(h);
            Steps from = steps_in(origin(f), mesh_.from_vertex_handle(h));
            for (std::uint32_t k = 0; k < 3 && !leave.is_valid(); ++k) {
                const Steps to = steps_in(origin(f), mesh_.to_vertex_handle(h));
                const std::int64_t side = turn(from, to, point);
                if (side < 0) leave = h;
                if (side == 0) on = h;
                from = to;
                h = mesh_.next_halfedge_handle(h);
            }
            if (!leave.is_valid()) return {f, on};
            f = mesh_.opposite_face_handle(leave);
        }
    }

    /// Inserts a point, searching from the face `near`. Returns a face at the point, in the same
    /// old triangle.
    FaceHandle insert(std::uint32_t point, FaceHandle near) {
        const Found found = locate(steps_in(origin(near), vertex(point)), near);
        if (found.edge.is_valid()) mesh_.split_copy(mesh_.edge_handle(found.edge), vertex(point));
        else mesh_.split_copy(found.face, vertex(point));
        restore(vertex(point));
        return found.face;
    }

    /// Flips edges opposite a new point until all its triangles are Delaunay. Terminates because
    /// each flip adds an edge to the point.
    void restore(VertexHandle point) {
        outgoing(mesh_, point, suspects_);
        std::erase_if(suspects_, [&](HalfedgeHandle h) { return mesh_.is_boundary(h); });
        for (HalfedgeHandle& h : suspects_) h = mesh_.next_halfedge_handle(h);
        while (!suspects_.empty()) {
            const HalfedgeHandle h = suspects_.back(), other = mesh_.opposite_halfedge_handle(h);
            suspects_.pop_back();
            const std::uint32_t triangle = origin(mesh_.face_handle(h));
            if (mesh_.is_boundary(other) || origin(mesh_.face_handle(other)) != triangle) continue;
            const Steps a = steps_in(triangle, mesh_.from_vertex_handle(h));
            const Steps b = steps_in(triangle, mesh_.to_vertex_handle(h));
            const Steps d = steps_in(triangle, mesh_.opposite_vh(other)),
                        p = steps_in(triangle, point);
            if (turn(p, d, b) <= 0 || turn(d, p, a) <= 0) continue;
            if (triangle != framed_) {
                frame_ = own_frame(old_, triangle);
                framed_ = triangle;
            }
            if (!is_in_circle(flat(a), flat(b), flat(p), flat(d))) continue;
            const EdgeHandle edge = mesh_.edge_handle(h);
            if (!mesh_.is_flip_ok(edge)) continue;
            suspects_.push_back(mesh_.next_halfedge_handle(other));
            suspects_.push_back(mesh_.prev_halfedge_handle(other));
            mesh_.flip(edge);
        }
    }

    HalfEdges& mesh_;
    const SurfaceMesh& old_;
    const std::vector<LatticePlace>& places_;
    MutualTessellation made_;
    OpenMesh::FPropHandleT<std::uint32_t> origin_;
    std::vector<std::uint32_t> place_of_point_;  ///< The index of each new point's position.
    std::uint32_t framed_ = TriangleEdge::none;
    FlatTriangle frame_;  ///< The frame of the old triangle `framed_`.
    std::vector<HalfedgeHandle> suspects_;
};

}  // namespace

Result<MutualTessellation> tessellate(HalfEdges& mesh, const SurfaceMesh& old,
                                      std::span<const SurfacePlace> places,
                                      const std::atomic<bool>& cancel) {
    if (places.size() > most_faces / 2 || old.triangles.size() > most_faces - 2 * places.size()) {
        return failure("the surface and its positions have more points than can be numbered");
    }
    const Result<std::vector<LatticePlace>> lattice = to_lattice(old, places);
    if (!lattice) return tl::unexpected(lattice.error());
    MutualTessellation made = Tessellator(mesh, old, *lattice).tessellate(cancel);
    if (cancel) return failure("re-tiling the surface was stopped");
    return made;
}

}  // namespace cascade
