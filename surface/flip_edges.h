// Improvement of triangles by flipping edges.
#pragma once

#include "mesh/half_edges.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Flips edges of a mesh if that improves the worst of what changes: the two triangles
/// (TriangleQuality::score()) and the folds at the edge and at the four sides. On a plane this is
/// Lawson's algorithm for the Delaunay triangulation, which maximises the smallest angle (R.
/// Sibson, "Locally equiangular triangulations", 1978). It turns no triangle upside down and
/// creates no second edge between two points.
class EdgeFlipper {
public:
    /// `normals` are those of the surface at the points. Queues the edges of all faces.
    EdgeFlipper(HalfEdges& mesh, std::span<const Vector3d> normals);

    /// Queues the edges of a changed face, unless it is deleted.
    void look_at(FaceHandle f);

    /// Processes the queue, including the edges of faces that change on the way. Terminates because
    /// every flip increases the sorted list of the scores of all triangles and edges. Stops early
    /// when `cancel` becomes true.
    void improve(const std::atomic<bool>& cancel);

private:
    /// The rating of an existing or possible triangle.
    struct Face {
        double score = 0;
        bool is_upright = true;
        Vector3d direction;  ///< Of its normal.
    };
    Face face(VertexHandle a, VertexHandle b, VertexHandle c) const;
    Face& at(FaceHandle f) { return faces_[static_cast<std::size_t>(f.idx())]; }
    void suspect(HalfedgeHandle h);
    double openness(const Face& one, HalfedgeHandle side);
    void flip_if_better(EdgeHandle e);

    HalfEdges& mesh_;
    std::span<const Vector3d> normals_;
    std::vector<Face> faces_;
    std::vector<EdgeHandle> suspects_;
};

}  // namespace cascade
