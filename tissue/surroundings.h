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

/// The position of the surroundings nearest to a cell.
struct NearPlace {
    static constexpr std::uint32_t no_triangle = 0xffffffff;

    SurfacePlace place{no_triangle, {1, 0, 0}};  ///< No triangle without a surface.
    Vector3d position;
    Vector3d normal{0, 0, 1};  ///< Of length 1, smooth in the position.
    /// The cell's distance from the position, negative on the inner side. Beyond the boundary of an
    /// open surface, the height above the plane that continues it.
    double off = 0;
    bool is_beyond = false;  ///< The position is on such a boundary.
};

/// Thread-safe.
class Surroundings {
public:
    virtual ~Surroundings() = default;

    /// The position nearest to a cell, searched from the triangle that was nearest before, or
    /// no_triangle. `off` is NaN if the point is not finite.
    virtual NearPlace near(Vector3d point, std::uint32_t triangle) const = 0;
    /// Does the same for several cells. All arrays have one length.
    virtual void near_all(std::span<const Vector3d> points,
                          std::span<const std::uint32_t> triangles,
                          std::span<NearPlace> result) const {
        for (std::size_t k = 0; k < points.size(); ++k) result[k] = near(points[k], triangles[k]);
    }
    /// Prefetches the data of this triangle for a call of near().
    virtual void prepare(std::uint32_t) const {}
    /// The position of a cell if walls stop it at the sides of a plane or at the boundary of an
    /// open surface, and periodic sides bring it back from the opposite one.
    virtual Vector3d held_inside(Vector3d point, const NearPlace& near) const = 0;
    /// Whether held_inside() may move cells.
    virtual bool holds() const = 0;
    /// Whether cells can be off a surface or a plane.
    virtual bool has_normal() const = 0;
    /// The periods of the tissue, or 0.
    virtual std::array<double, 3> period() const { return {}; }
    /// The surface. Null without one.
    virtual const SurfaceMesh* mesh() const { return nullptr; }
    /// The box in which founders are scattered without a surface.
    virtual Vector3d extent() const = 0;
};

/// Around a surface with triangles, in script units. The mesh must outlive it.
std::unique_ptr<Surroundings> around_surface(const SurfaceMesh& mesh);

/// On a plane from (0, 0) to `extent`, along whose axes the tissue repeats or walls hold it. The
/// normal is (0, 0, 1), and `off` is z. In space, with a depth above 0, cells cannot be off: `off`
/// is 0.
std::unique_ptr<Surroundings> in_box(Vector3d extent, std::array<bool, 3> is_periodic);

}  // namespace cascade
