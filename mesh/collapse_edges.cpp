// Decides which edges may be collapsed; OpenMesh checks the link condition and collapses them.
#include "mesh/collapse_edges.h"

namespace cascade {

namespace {

constexpr double least_cosine = 0.26;  ///< Of the rotation of a triangle: 75°.
constexpr unsigned most_neighbours = 10;

/// Whether the triangles around a vertex keep their shape if it moves to `to`, merged with `other`.
bool stays_smooth(const HalfEdges& mesh, VertexHandle v, VertexHandle other, Vector3d to,
                  double longest) {
    const Vector3d from = position(mesh, v);
    for (const HalfedgeHandle h : mesh.voh_range(v)) {
        const VertexHandle b = mesh.to_vertex_handle(h), c = mesh.opposite_vh(h);
        if (b == other || c == other) continue;
        const Vector3d at_b = position(mesh, b), at_c = position(mesh, c);
        const Vector3d before = cross(at_b - from, at_c - from);
        const Vector3d along = at_b - to;
        const Vector3d after = cross(along, at_c - to);
        const bool turns = dot(before, after) < least_cosine * length(before) * length(after);
        // A triangle without area has no direction, and no use.
        if (turns || length(after) <= 0.02 * dot(along, along) ||
            dot(along, along) > longest * longest) {
            return false;
        }
    }
    return true;
}

void try_edge(HalfEdges& mesh, HalfedgeHandle h, double shortest, double longest) {
    const HalfedgeHandle other = mesh.opposite_halfedge_handle(h);
    const VertexHandle a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
    const Vector3d from = position(mesh, a), apart = position(mesh, b) - from;
    if (dot(apart, apart) >= shortest * shortest) return;
    // A vertex with three triangles would keep two, which would coincide.
    if (mesh.valence(mesh.opposite_vh(h)) < 4 || mesh.valence(mesh.opposite_vh(other)) < 4) return;
    if (mesh.valence(a) + mesh.valence(b) > most_neighbours + 4) return;
    const Vector3d middle = from + apart * 0.5;
    if (!stays_smooth(mesh, a, b, middle, longest) || !stays_smooth(mesh, b, a, middle, longest))
        return;
    if (!mesh.is_collapse_ok(other)) return;
    mesh.set_point(a, {middle.x, middle.y, middle.z});
    mesh.collapse(other);  // b is replaced by a.
}

}  // namespace

void collapse_edges(HalfEdges& mesh, double shortest, double longest) {
    for (const FaceHandle f : mesh.all_faces()) {
        HalfedgeHandle h = mesh.halfedge_handle(f);
        for (int k = 0; k < 3 && !mesh.status(f).deleted(); ++k, h = mesh.next_halfedge_handle(h)) {
            try_edge(mesh, h, shortest, longest);
        }
    }
}

}  // namespace cascade
