// Decides which flips improve a surface; OpenMesh does them.
#include "surface/flip_edges.h"

#include "surface/triangle_quality.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double least_gain = 1e-9;   ///< Of a score; above rounding errors.
constexpr double upside_down = 0.05;  ///< A mean cosine.

/// Rates the fold at an edge between triangles: 1 up to a right angle, 0 if they lie on each other.
double openness_between(Vector3d one, Vector3d other) { return std::min(1.0, 1 + dot(one, other)); }

}  // namespace

EdgeFlipper::EdgeFlipper(HalfEdges& mesh, std::span<const Vector3d> normals)
    : mesh_(mesh), normals_(normals), faces_(mesh.n_faces()) {
    for (const FaceHandle f : mesh.faces()) look_at(f);
}

/// Queues an edge once; its tag marks it as queued.
void EdgeFlipper::suspect(HalfedgeHandle h) {
    const EdgeHandle e = mesh_.edge_handle(h);
    if (mesh_.status(e).tagged()) return;
    mesh_.status(e).set_tagged(true);
    suspects_.push_back(e);
}

void EdgeFlipper::look_at(FaceHandle f) {
    if (mesh_.status(f).deleted()) return;
    const HalfedgeHandle h = mesh_.halfedge_handle(f);
    at(f) = face(mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h), mesh_.opposite_vh(h));
    for (const HalfedgeHandle side :
         {h, mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)}) {
        suspect(side);
    }
}

void EdgeFlipper::improve(const std::atomic<bool>& cancel) {
    while (!suspects_.empty() && !cancel) {
        const EdgeHandle e = suspects_.back();
        suspects_.pop_back();
        mesh_.status(e).set_tagged(false);
        if (!mesh_.status(e).deleted() && !mesh_.is_boundary(e)) flip_if_better(e);
    }
}

EdgeFlipper::Face EdgeFlipper::face(VertexHandle a, VertexHandle b, VertexHandle c) const {
    const Vector3d at_a = position(mesh_, a), at_b = position(mesh_, b), at_c = position(mesh_, c);
    const TriangleQuality quality =
        quality_of({at_a, at_b, at_c},
                   {normals_[number(a)], normals_[number(b)], normals_[number(c)]});
    return {quality.score(), quality.mean_cosine > upside_down,
            unit(cross(at_b - at_a, at_c - at_a))};
}

/// The rating of the fold between a triangle and its neighbour across a side.
double EdgeFlipper::openness(const Face& one, HalfedgeHandle side) {
    const FaceHandle other = mesh_.opposite_face_handle(side);
    return other.is_valid() ? openness_between(one.direction, at(other).direction) : 1;
}

/// Flips an edge if that improves the worst of its triangles and of the folds at it and their
/// sides.
void EdgeFlipper::flip_if_better(EdgeHandle e) {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
    const VertexHandle c = mesh_.opposite_vh(h), d = mesh_.opposite_vh(o);
    if (c == d) return;
    const HalfedgeHandle bc = mesh_.next_halfedge_handle(h), ca = mesh_.prev_halfedge_handle(h);
    const HalfedgeHandle ad = mesh_.next_halfedge_handle(o), db = mesh_.prev_halfedge_handle(o);
    const Face &one = at(mesh_.face_handle(h)), &other = at(mesh_.face_handle(o));
    const double before =
        least_gain + std::min({one.score, other.score, openness(one, h), openness(one, bc),
                               openness(one, ca), openness(other, ad), openness(other, db)});
    const Face first = face(c, d, mesh_.to_vertex_handle(h));
    if (!first.is_upright || first.score <= before) return;
    const Face second = face(d, c, mesh_.from_vertex_handle(h));
    if (!second.is_upright || second.score <= before) return;
    const double folds =
        std::min({openness_between(first.direction, second.direction), openness(first, bc),
                  openness(first, db), openness(second, ca), openness(second, ad)});
    if (folds <= before || are_neighbours(mesh_, c, d)) return;
    mesh_.flip(e);
    at(mesh_.face_handle(bc)) = first;
    at(mesh_.face_handle(ca)) = second;
    for (const HalfedgeHandle side : {bc, ca, ad, db}) suspect(side);
}

}  // namespace cascade
