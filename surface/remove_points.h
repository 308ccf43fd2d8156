// Taking points away from a surface without opening it: the second part of G. Turk's re-tiling
// (thesis, section 5.3.1).
#pragma once

#include "surface/edited_mesh.h"
#include "surface/fill_hole.h"
#include "surface/triangle_quality.h"

#include <optional>

namespace cascade {

/// Why a point could not be taken away.
enum class WhyKept {
    boundary,  ///< The boundary would move, or have an edge much longer than places are apart.
    topology,  ///< Two points would have two edges, or a piece or a boundary would vanish.
    fold,      ///< A new triangle would lie upside down or have no area.
};

/// How closely new triangles must follow the surface.
enum class Care {
    high,  ///< They lean less than 75° against each corner's normal.
    low,   ///< They lean less than 85° against the mean of these.
};

/// Removes points of one mesh.
class PointRemoval {
public:
    /// `normals` are those of the surface at the points, of length 1; `spacing` is how far
    /// places are apart.
    PointRemoval(EditedMesh& mesh, const std::vector<Vector3d>& normals, double spacing)
        : mesh_(mesh), normals_(normals), spacing_(spacing), moved_(mesh.mesh().points.size()) {}

    /// Takes a point away with its fan and fills the hole with triangles of the rim: of all ways
    /// the one whose worst triangle has the best score. Turk projects the rim to a tangent plane,
    /// where it may overlap itself; this needs no plane. A rim of more than 24 points, for which
    /// that would take long, is unrolled into a plane and its ears are cut off.
    ///
    /// Leaves everything as it is and says why where the point must stay. A point at a boundary
    /// goes only where the boundary stays within 1/10 of the spacing and the new edge is no longer
    /// than twice the spacing.
    std::optional<WhyKept> remove(std::uint32_t point, Care care);

private:
    bool may_leave_boundary(std::uint32_t point);
    void note_moved(std::uint32_t point);
    bool has_rim_twice();
    bool may_close();
    bool is_new(const RimTriangle& corners);
    TriangleQuality quality(const RimTriangle& corners) const;
    std::vector<RimTriangle> best_filling(Care care);
    std::vector<RimTriangle> cut_ears_around(std::uint32_t point, Care care);
    void unroll_fan(std::uint32_t point);

    EditedMesh& mesh_;
    const std::vector<Vector3d>& normals_;
    double spacing_;
    std::vector<double>
        moved_;  ///< How far the boundary edge that begins at a point has moved at most.
    Fan fan_;
    bool meets_edge_ = false;  ///< A triangle was refused because two points had an edge already.
    std::vector<std::uint32_t> sorted_;
    std::vector<double> distances_, angles_;
    std::vector<Vector2d> flat_;
};

}  // namespace cascade
