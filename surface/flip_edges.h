// Better triangles over the same points.
#pragma once

#include "mesh/half_edges.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Flips edges of a mesh where the worst of what changes becomes better: the two triangles
/// (TriangleQuality::score()) and the folds at the edge and at their four sides. On a plane that is
/// Lawson's way to the Delaunay triangulation, whose smallest angles are the largest (R. Sibson,
/// "Locally equiangular triangulations", 1978). No triangle is turned upside down and no two points
/// get a second edge.
class EdgeFlipper {
public:
    /// `normals` are those of the surface at the points. All faces are looked at first.
    EdgeFlipper(HalfEdges& mesh, std::span<const Vector3d> normals);

    /// Notes that a face has changed, unless it is gone.
    void look_at(FaceHandle f);

    /// Looks at the edges of all faces that were noted, and then at those of faces it changes
    /// itself. Ends because the scores of all triangles and edges, sorted, grow with every flip.
    /// Stops early when `cancel` becomes true.
    void improve(const std::atomic<bool>& cancel);

private:
    /// A triangle as it is or might be.
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
    std::vector<Face> faces_;  ///< Of each face.
    std::vector<EdgeHandle> suspects_;
};

}  // namespace cascade
