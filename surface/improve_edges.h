// Better triangles over the same points.
#pragma once

#include "surface/edited_mesh.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Exchanges edges of a mesh where the worst of what changes becomes better: the two triangles
/// (TriangleQuality::score()) and the folds at the edge and at their four sides. On a plane that is
/// Lawson's way to the Delaunay triangulation, whose smallest angles are the largest (R. Sibson,
/// "Locally equiangular triangulations", 1978). No triangle is turned upside down and no two points
/// get a second edge.
class EdgeImprover {
public:
    /// `normals` are those of the surface at the points.
    EdgeImprover(EditedMesh& mesh, std::span<const Vector3d> normals)
        : edited_(mesh), normals_(normals) {}

    /// Looks at all triangles that were changed since the last call, and then at those it changes
    /// itself. Ends because the scores of all triangles and edges, sorted, grow with every
    /// exchange. Stops early when `cancel` becomes true.
    void improve(const std::atomic<bool>& cancel);

private:
    /// A triangle as it is or might be.
    struct Face {
        double score = 0;
        bool is_upright = true;
        Vector3d direction;  ///< Of its normal.
    };
    const SurfaceMesh& mesh() const { return edited_.mesh(); }
    Face face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    void look_at_changed();
    static double openness(const Face& one, const Face& other);
    double openness(const Face& one, TriangleEdge side) const;
    bool is_better_exchanged(TriangleEdge edge, TriangleEdge other) const;

    EditedMesh& edited_;
    std::span<const Vector3d> normals_;
    std::vector<Face> faces_;  ///< Of each triangle.
    std::vector<TriangleEdge> suspects_;
};

}  // namespace cascade
