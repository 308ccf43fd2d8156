// Removes points from a surface: the second part of G. Turk's re-tiling (thesis, section 5.3.1).
#pragma once

#include "mesh/half_edges.h"
#include "surface/fill_hole.h"
#include "surface/retile.h"
#include "surface/triangle_quality.h"

#include <optional>

namespace cascade {

/// The accuracy with which new triangles must follow the surface.
enum class Care {
    high,  ///< Within 75° of each corner's normal.
    low,   ///< Within 85° of the mean of the corners' normals.
};

class PointRemoval {
public:
    /// `normals` are the surface's unit normals at the points. `spacing` is the distance between
    /// cells.
    PointRemoval(HalfEdges& mesh, const std::vector<Vector3d>& normals, double spacing)
        : mesh_(mesh), normals_(normals), spacing_(spacing), moved_(mesh.n_vertices()) {}

    /// Removes a point and triangulates the hole over its one-ring such that the worst triangle has
    /// the best score. Turk projects the ring to a tangent plane, where the ring may overlap
    /// itself. The method here needs no plane. It would take long for a ring of more than 24
    /// points, so such a ring is unrolled into a plane and its ears are cut off. Returns nullopt if
    /// the point was removed. Otherwise changes nothing and returns the reason why the point must
    /// stay. A point at a boundary is removed only if the boundary moves by at most 1/10 of the
    /// spacing and the new edge is no longer than twice the spacing.
    std::optional<WhyKept> remove(std::uint32_t point, Care care);

    /// The faces around the last removed point. The faces that are not deleted fill its hole.
    const std::vector<FaceHandle>& changed() const { return changed_; }

private:
    Vector3d place(std::uint32_t point) const { return position(mesh_, vertex(point)); }
    void take_ring(std::uint32_t point);
    bool may_leave_boundary(std::uint32_t point);
    void note_moved(std::uint32_t point);
    bool has_point_twice();
    bool may_close();
    bool is_new(const RingTriangle& corners);
    TriangleQuality quality(const RingTriangle& corners) const;
    std::vector<RingTriangle> best_filling(Care care);
    std::vector<RingTriangle> cut_ears_around(std::uint32_t point, Care care);
    void unroll_ring(std::uint32_t point);
    void fill(std::span<const RingTriangle> triangles);

    HalfEdges& mesh_;
    const std::vector<Vector3d>& normals_;
    double spacing_;
    /// The largest distance by which each boundary edge may have moved, by the first point of the
    /// edge.
    std::vector<double> moved_;
    /// The half-edges from the removed point, counterclockwise.
    std::vector<HalfedgeHandle> spokes_;
    std::vector<std::uint32_t> ring_;  ///< The vertices at the ends of the spokes.
    bool is_closed_ = false;   ///< Whether the ring is closed: the point is not at a boundary.
    bool meets_edge_ = false;  ///< Whether a triangle was refused because an edge existed already.
    std::vector<FaceHandle> changed_;
    std::vector<std::uint32_t> sorted_;
    std::vector<double> distances_, angles_;
    std::vector<Vector2d> flat_;
};

}  // namespace cascade
