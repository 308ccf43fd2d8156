// Collapses of short edges.
#pragma once

#include "mesh/half_edges.h"

namespace cascade {

/// The vertex that is left where each one was, if each has merged into another one or itself.
std::vector<std::uint32_t> ends_of_chains(std::vector<std::uint32_t> into);

/// What is known of vertices that have merged. Keeps rims, corners and tips where they are, which
/// midpoints would wear away.
class MergedVertices {
public:
    explicit MergedVertices(const HalfEdges& mesh);

    /// An end of an edge, or its midpoint: where the sum of the squared distances from the planes
    /// of all triangles that have merged there, weighted by their areas, is least (M. Garland and
    /// P. Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997).
    Vector3d place(const HalfEdges& mesh, VertexHandle a, VertexHandle b) const;
    void merge(VertexHandle stays, VertexHandle goes);

    /// The vertex that is left where each one was, by index.
    std::vector<std::uint32_t> left() const { return ends_of_chains(into_); }

private:
    std::vector<PlaneQuadric> planes_;  ///< Of the triangles at each vertex.
    std::vector<std::uint32_t> into_;
};

/// Whether the triangles around a vertex keep their shape if it moves to `to`, merged with `other`,
/// to which it must have one edge only: no triangle rotates by more than 75° or becomes a sliver,
/// and no edge becomes longer than `longest`.
bool keep_shape(const HalfEdges& mesh, VertexHandle v, VertexHandle other, Vector3d to,
                double longest);

/// Collapses edges shorter than `shortest`, in order of their faces, to their midpoints or to the
/// places that `merged` says, if that preserves the shape of the surface: the link condition holds
/// (T. Dey et al., "Topology Preserving Edge Contraction", Publ. Inst. Math. Beograd 66, 1999), no
/// triangle rotates by more than 75°, and no edge becomes longer than `longest`. Boundaries stay.
void collapse_edges(HalfEdges& mesh, double shortest, double longest,
                    MergedVertices* merged = nullptr);

}  // namespace cascade
