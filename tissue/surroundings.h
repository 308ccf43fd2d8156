// What surrounds the cells of a tissue: a surface, a plane, or nothing.
//
// All lengths are those of scripts.
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

/// The place of the surroundings that is nearest to a cell.
struct NearPlace {
    static constexpr std::uint32_t no_triangle = 0xffffffff;

    SurfacePlace place{no_triangle, {1, 0, 0}};  ///< Without a surface no triangle.
    Vector3d position;
    Vector3d normal{0, 0, 1};  ///< Of length 1, changing smoothly from place to place.
    /// The distance from there, negative on the inner side; beyond the boundary of an open surface
    /// the height over the plane that continues it.
    double off = 0;
    bool is_beyond = false;  ///< The place is on such a boundary.
};

/// Thread-safe.
class Surroundings {
public:
    virtual ~Surroundings() = default;

    /// The place nearest to a cell, by way of the triangle that was nearest to it before or
    /// no_triangle. `off` is NaN if the point is not finite.
    virtual NearPlace near(Vector3d point, std::uint32_t triangle) const = 0;
    /// The same for several cells; all have one length.
    virtual void near_all(std::span<const Vector3d> points,
                          std::span<const std::uint32_t> triangles,
                          std::span<NearPlace> result) const {
        for (std::size_t k = 0; k < points.size(); ++k) result[k] = near(points[k], triangles[k]);
    }
    /// Says that near() will be asked about this triangle soon, so that its data comes to the
    /// cache.
    virtual void prepare(std::uint32_t) const {}
    /// Where a cell is if walls stop it at the sides of a plane or at the boundary of an open
    /// surface, and periodic sides bring it back from the opposite one.
    virtual Vector3d held_inside(Vector3d point, const NearPlace& near) const = 0;
    /// Whether held_inside() may put cells elsewhere.
    virtual bool holds() const = 0;
    /// Whether there is a surface or a plane that cells can be off.
    virtual bool has_normal() const = 0;
    /// The lengths after which the tissue repeats, or 0.
    virtual std::array<double, 3> period() const { return {}; }
    /// The surface; null for others.
    virtual const SurfaceMesh* mesh() const { return nullptr; }
    /// The box in which founders are scattered where there is no surface.
    virtual Vector3d extent() const = 0;
};

/// Around a surface with triangles, given in lengths of scripts; the mesh must outlive it.
std::unique_ptr<Surroundings> around_surface(const SurfaceMesh& mesh);

/// On a plane from (0, 0) to `extent`, along whose axes the tissue repeats or walls hold it. The
/// normal is (0, 0, 1), and `off` is z. In space, with a depth above 0, there is nothing to be off
/// from: `off` is 0.
std::unique_ptr<Surroundings> in_box(Vector3d extent, std::array<bool, 3> is_periodic);

}  // namespace cascade
