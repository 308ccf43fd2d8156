// The mesh that is edited: OpenMesh's half-edges. No other file of the rooms includes OpenMesh.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

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

/// Triangles that can be flipped, split and collapsed. A half-edge has its face on the left, none
/// at a boundary. Debian's OpenMesh is compiled with its assertions: flip() ends the program where
/// is_flip_ok() does not hold. Copies are deep, and so are moves.
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// The most faces that can be: half-edges, up to six for each, are numbered by `int`.
inline constexpr std::size_t most_faces = std::numeric_limits<int>::max() / 6;

/// The points and triangles of `mesh` with their numbers; the half-edge of a face is that from its
/// first corner to its second. Two edges between the same two points stay two: add_face() looks
/// edges up by their ends and would make them one, so half-edges are linked by `across` instead.
/// is_flip_ok() never lets a second edge come about; is_collapse_ok() does not see one that is
/// there.
///
/// Fails on what is no SurfaceMesh: corners that are no points, a triangle with a corner twice,
/// edges that do not fit what is across, points with several fans of triangles; and on more edges
/// than can be numbered. Throws std::bad_alloc.
Result<HalfEdges> half_edges(const SurfaceMesh& mesh);

/// The mesh of `vertices`, in this order; they must be all that faces use. Triangles follow each
/// other as the faces do. (OpenMesh's garbage_collection() fills gaps from the end.)
SurfaceMesh surface_mesh(const HalfEdges& mesh, std::span<const std::uint32_t> vertices);
/// The same of all vertices that are not deleted, in their order.
SurfaceMesh surface_mesh(const HalfEdges& mesh);

inline VertexHandle vertex(std::uint32_t point) { return VertexHandle(static_cast<int>(point)); }
inline std::uint32_t number(VertexHandle v) { return static_cast<std::uint32_t>(v.idx()); }

inline Vector3d position(const HalfEdges& mesh, VertexHandle v) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    return {p[0], p[1], p[2]};
}

/// The half-edges out of a vertex, counterclockwise; at a boundary the first has a face and the
/// last has none.
void outgoing(const HalfEdges& mesh, VertexHandle v, std::vector<HalfedgeHandle>& spokes);

/// Whether an edge goes from one vertex to the other. Looks at both in turn, so that it takes no
/// longer than the smaller one-ring does.
bool are_neighbours(const HalfEdges& mesh, VertexHandle a, VertexHandle b);

}  // namespace cascade
