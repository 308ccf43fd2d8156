// Collapses short edges.
#pragma once

#include "mesh/half_edges.h"

namespace cascade {

/// Resolves chains of merges. `into[v]` is the vertex into which v has merged, or v itself. Returns
/// for each vertex the surviving vertex at the end of its chain.
std::vector<std::uint32_t> ends_of_chains(std::vector<std::uint32_t> into);

/// Records which vertices have merged, and chooses the positions of merged vertices. Unlike
/// midpoints, these positions preserve rims, corners and tips.
class MergedVertices {
public:
    explicit MergedVertices(const HalfEdges& mesh);

    /// The position for a vertex merged from a and b: one of the ends of their edge or its
    /// midpoint. Chooses the position with the least sum, weighted by area, of squared distances
    /// from the planes of all triangles merged into a and b (M. Garland and P. Heckbert, "Surface
    /// Simplification Using Quadric Error Metrics", SIGGRAPH 1997).
    Vector3d place(const HalfEdges& mesh, VertexHandle a, VertexHandle b) const;
    void merge(VertexHandle stays, VertexHandle goes);

    /// The surviving vertex for each vertex, by index.
    std::vector<std::uint32_t> left() const { return ends_of_chains(into_); }

private:
    std::vector<PlaneQuadric> planes_;  ///< The triangles' planes at each vertex.
    std::vector<std::uint32_t> into_;
};

/// Whether vertex v can move to `to` and merge with `other` without spoiling the triangles around
/// v: no triangle rotates by more than 75° or becomes a sliver, and no edge becomes longer than
/// `longest`. Only one edge may join the two vertices.
bool keep_shape(const HalfEdges& mesh, VertexHandle v, VertexHandle other, Vector3d to,
                double longest);

/// Collapses edges shorter than `shortest`, in the order of their faces. The merged vertex gets the
/// midpoint, or the position that `merged` chooses. Collapses only edges that preserve the
/// surface's shape: the link condition holds (T. Dey et al., "Topology Preserving Edge
/// Contraction", Publ. Inst. Math. Beograd 66, 1999), no triangle rotates by more than 75°, and no
/// edge becomes longer than `longest`. Boundaries stay.
void collapse_edges(HalfEdges& mesh, double shortest, double longest,
                    MergedVertices* merged = nullptr);

}  // namespace cascade
