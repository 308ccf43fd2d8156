// Decides which edges may be collapsed. OpenMesh checks the link condition and collapses them.
#include "mesh/collapse_edges.h"

#include <numeric>

namespace cascade {

namespace {

/// The cosine of 75°, the largest angle by which a triangle may rotate.
constexpr double least_cosine = 0.26;
constexpr unsigned most_edges_at_point = 10;

void try_edge(HalfEdges& mesh, HalfedgeHandle h, double shortest, double longest,
              MergedVertices* merged) {
    const HalfedgeHandle other = mesh.opposite_halfedge_handle(h);
    const VertexHandle a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
    const Vector3d from = position(mesh, a), apart = position(mesh, b) - from;
    if (dot(apart, apart) >= shortest * shortest) return;
    if (mesh.is_boundary(a) || mesh.is_boundary(b)) return;
    // If a vertex opposite the edge had only three triangles, two coinciding triangles would remain
    // at that vertex after the collapse.
    if (mesh.valence(mesh.opposite_vh(h)) < 4 || mesh.valence(mesh.opposite_vh(other)) < 4) return;
    if (mesh.valence(a) + mesh.valence(b) > most_edges_at_point + 4) return;
    const Vector3d to = merged ? merged->place(mesh, a, b) : from + apart * 0.5;
    if (!keep_shape(mesh, a, b, to, longest) || !keep_shape(mesh, b, a, to, longest)) return;
    if (!mesh.is_collapse_ok(other)) return;
    mesh.set_point(a, {to.x, to.y, to.z});
    mesh.collapse(other);  // Vertex a remains.
    if (merged) merged->merge(a, b);
}

}  // namespace

bool keep_shape(const HalfEdges& mesh, VertexHandle v, VertexHandle other, Vector3d to,
                double longest) {
    const Vector3d from = position(mesh, v);
    int vanishing = 0;
    for (const HalfedgeHandle h : mesh.voh_range(v)) {
        const VertexHandle b = mesh.to_vertex_handle(h), c = mesh.opposite_vh(h);
        if (b == other || c == other) {
            ++vanishing;
            continue;
        }
        if (mesh.is_boundary(h)) continue;  // There is no triangle here.
        const Vector3d at_b = position(mesh, b), at_c = position(mesh, c);
        const Vector3d before = cross(at_b - from, at_c - from);
        const Vector3d along = at_b - to;
        const Vector3d after = cross(along, at_c - to);
        const bool turns = dot(before, after) < least_cosine * length(before) * length(after);
        // A nearly degenerate triangle has no reliable direction.
        if (turns || length(after) <= 0.02 * dot(along, along) ||
            dot(along, along) > longest * longest) {
            return false;
        }
    }
    return vanishing == 2;
}

MergedVertices::MergedVertices(const HalfEdges& mesh)
    : planes_(mesh.n_vertices()), into_(mesh.n_vertices()) {
    std::iota(into_.begin(), into_.end(), std::uint32_t{0});
    for (const FaceHandle f : mesh.faces()) {
        const HalfedgeHandle h = mesh.halfedge_handle(f);
        const VertexHandle a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h),
                           c = mesh.opposite_vh(h);
        const Vector3d at = position(mesh, a);
        const Vector3d normal = cross(position(mesh, b) - at, position(mesh, c) - at);
        const Vector3d n = unit(normal);
        PlaneQuadric plane(n.x, n.y, n.z, -dot(n, at));
        plane *= length(normal);
        for (const VertexHandle v : {a, b, c}) planes_[number(v)] += plane;
    }
}

Vector3d MergedVertices::place(const HalfEdges& mesh, VertexHandle a, VertexHandle b) const {
    const auto planes = planes_[number(a)] + planes_[number(b)];
    const OpenMesh::Vec3d ends[] = {mesh.point(a), mesh.point(b)};
    OpenMesh::Vec3d best = (ends[0] + ends[1]) * 0.5;
    double least = planes(best);
    for (const OpenMesh::Vec3d& end : ends) {
        const double error = planes(end);
        if (error >= least) continue;
        least = error;
        best = end;
    }
    return {best[0], best[1], best[2]};
}

void MergedVertices::merge(VertexHandle stays, VertexHandle goes) {
    planes_[number(stays)] += planes_[number(goes)];
    into_[number(goes)] = number(stays);
}

std::vector<std::uint32_t> ends_of_chains(std::vector<std::uint32_t> into) {
    for (std::uint32_t& v : into) {
        while (v != into[v]) v = into[v] = into[into[v]];
    }
    return into;
}

void collapse_edges(HalfEdges& mesh, double shortest, double longest, MergedVertices* merged) {
    for (const FaceHandle f : mesh.all_faces()) {
        HalfedgeHandle h = mesh.halfedge_handle(f);
        for (int k = 0; k < 3 && !mesh.status(f).deleted(); ++k, h = mesh.next_halfedge_handle(h)) {
            try_edge(mesh, h, shortest, longest, merged);
        }
    }
}

}  // namespace cascade
