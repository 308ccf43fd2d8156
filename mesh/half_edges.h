// The editable mesh: OpenMesh's half-edges. Only simplify.cpp and subdivide.cpp, which use
// OpenMesh's tools, include OpenMesh themselves.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// QuadricT.hh must be included after the header above.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <limits>
#include <span>
#include <vector>

namespace cascade {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};

/// Triangles that can be flipped, split and collapsed. The face of a half-edge is on its left. A
/// half-edge at a boundary has no face. Debian compiles OpenMesh with assertions: flip() aborts
/// unless is_flip_ok() holds. Copies are deep, and moves copy, too.
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// The sum of the squared distances of a point from planes.
using PlaneQuadric = OpenMesh::Geometry::Quadricd;

/// The largest number of faces. OpenMesh numbers half-edges by `int`, and a face may need six
/// half-edges.
inline constexpr std::size_t most_faces = std::numeric_limits<int>::max() / 6;

/// The points and triangles of `mesh` with their indices. The half-edge of a face goes from its
/// first corner to its second. Two edges between the same points stay separate: this function links
/// half-edges by `across`, because add_face() would look edges up by their ends and merge such
/// edges. is_flip_ok() prevents new double edges, but is_collapse_ok() does not notice existing
/// ones.
///
/// Fails on invalid meshes: corners that are no points, a triangle with a repeated corner, edges
/// that do not match their neighbours, points with several fans of triangles. Fails on more edges
/// than can be indexed. Throws std::bad_alloc.
Result<HalfEdges> half_edges(const SurfaceMesh& mesh);

/// The mesh of `vertices`, in this order. They must include the corners of all faces. Triangles are
/// in the order of faces. (OpenMesh's garbage_collection() would fill gaps with the last elements,
/// which changes these orders.)
SurfaceMesh surface_mesh(const HalfEdges& mesh, std::span<const std::uint32_t> vertices);
/// The mesh of all vertices that are not deleted, in their order.
SurfaceMesh surface_mesh(const HalfEdges& mesh);

inline VertexHandle vertex(std::uint32_t point) { return VertexHandle(static_cast<int>(point)); }
inline std::uint32_t number(VertexHandle v) { return static_cast<std::uint32_t>(v.idx()); }

inline Vector3d position(const HalfEdges& mesh, VertexHandle v) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    return {p[0], p[1], p[2]};
}

/// Writes to `spokes` the half-edges that begin at a vertex, counterclockwise. At a boundary, only
/// the last half-edge has no face.
void outgoing(const HalfEdges& mesh, VertexHandle v, std::vector<HalfedgeHandle>& spokes);

/// Whether an edge joins two vertices. Takes time proportional to the smaller of their one-rings.
bool are_neighbours(const HalfEdges& mesh, VertexHandle a, VertexHandle b);

}  // namespace cascade
