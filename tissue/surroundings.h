// The surroundings of a tissue's cells: a surface, a plane, or empty space.
//
// All lengths are in script units.
#pragma once

#include "mesh/flat.h"
#include "surface/place_follower.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The position of the surroundings that is nearest to a cell.
struct NearPlace {
    static constexpr std::uint32_t no_triangle = 0xffffffff;

    /// The position on the surface. Has no triangle if there is no surface.
    SurfacePlace place{no_triangle, {1, 0, 0}};
    Vector3d position;
    Vector3d normal{0, 0, 1};  ///< Of length 1. Varies smoothly with the position.
    /// The cell's distance from `position`, negative on the inner side. For a cell beyond the
    /// boundary of an open surface, the cell's height above the plane that continues the surface.
    double off = 0;
    bool is_beyond = false;  ///< Whether the cell is beyond the boundary of an open surface.
};

/// The space around the cells of a tissue. Thread-safe.
class Surroundings {
public:
    virtual ~Surroundings() = default;

    /// The position nearest to a cell at `point`. The search begins at `triangle`, which was
    /// nearest at an earlier moment, or is no_triangle. `off` is NaN if the point is not finite.
    virtual NearPlace near(Vector3d point, std::uint32_t triangle) const = 0;
    /// Calls near() for several cells. All arrays have the same length.
    virtual void near_all(std::span<const Vector3d> points,
                          std::span<const std::uint32_t> triangles,
                          std::span<NearPlace> result) const {
        for (std::size_t k = 0; k < points.size(); ++k) result[k] = near(points[k], triangles[k]);
    }
    /// Prefetches the data of this triangle for a call of near().
    virtual void prepare(std::uint32_t) const {}
    /// The position to which a cell is held. Walls stop the cell at the sides of a plane or at the
    /// boundary of an open surface. Periodic sides move the cell to the opposite side.
    virtual Vector3d held_inside(Vector3d point, const NearPlace& near) const = 0;
    /// Whether held_inside() may change positions.
    virtual bool holds() const = 0;
    /// Whether there is a surface or a plane, from which cells have a distance.
    virtual bool has_normal() const = 0;
    /// The period of the tissue along each axis; 0 along an axis that is not periodic.
    virtual std::array<double, 3> period() const { return {}; }
    /// The surface; null if the surroundings have no surface.
    virtual const SurfaceMesh* mesh() const { return nullptr; }
    /// The box in which founders are scattered if there is no surface.
    virtual Vector3d extent() const = 0;
};

/// The surroundings given by a surface in script units, which must have triangles. The mesh must
/// outlive the result.
std::unique_ptr<Surroundings> around_surface(const SurfaceMesh& mesh);

/// The surroundings given by a plane from (0, 0) to `extent`. Along each axis, the tissue is
/// periodic, or walls stop cells at the sides. The normal is (0, 0, 1), and `off` is z. If `extent`
/// has a depth above 0, the surroundings are a box in space instead of a plane, and `off` is 0.
std::unique_ptr<Surroundings> in_box(Vector3d extent, std::array<bool, 3> is_periodic);

}  // namespace cascade
