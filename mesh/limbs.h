// Bodies of limbs: flesh around smooth curves, blended into one implicit surface.
#pragma once

#include "core/result.h"
#include "core/vector3.h"
#include "core/wide_vectors.h"
#include "mesh/surface_mesh.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// A point of the curve in the middle of a limb, and the radius of the flesh around it.
struct Joint {
    double x = 0, y = 0, z = 0;
    double radius = 0;
};

enum class Sides { one, both };  ///< With `both`, the limb has a mirror image, with x negated.

/// Flesh around the smooth curve through `joints`, of which there is at least one. The flesh ends
/// in half balls.
struct Limb {
    std::vector<Joint> joints;
    double softness = 0;  ///< The length over which the limb blends with others.
    Sides sides = Sides::one;
    /// The thickness along x, y and z as fractions of the radius, at most 1.
    Vector3d flat{1, 1, 1};
};

/// An implicit body. Its function is the sum over the limbs of (1 − d / 4s)⁴, minus 1. d is the
/// distance from a limb's flesh, negative inside, and s is the limb's softness. Limbs further away
/// than 4s do not count. These are the soft objects of G. Wyvill, C. McPheeters, B. Wyvill, "Data
/// Structure for Soft Objects", The Visual Computer 2, 1986, around cones in place of points.
/// Curves are Catmull–Rom splines parametrised by chord length.
class LimbBody {
public:
    explicit LimbBody(const std::vector<Limb>& limbs);

    /// The value of the body's function at p: positive inside, −1 far outside.
    double operator()(Vector3d p) const;
    /// Computes the function's values at many points. Fastest if successive points are near each
    /// other.
    void evaluate(std::span<const Vector3d> points, std::span<double> values) const;

    /// The surface, moved so that its lowest point is at y = 0. `edge` is the approximate length of
    /// the triangles' edges. Fails as implicit_surface() does.
    Result<SurfaceMesh> mesh(double edge, const std::atomic<bool>& cancel) const;

private:
    /// The number of points that are evaluated together, so that compilers use vectors.
    static constexpr std::size_t block_size = 8;
    using Numbers = std::array<double, block_size>;
    struct Block {
        Numbers x, y, z;

        SurfaceMesh::Box box() const;
    };
    /// A bounding ball.
    struct Ball {
        Vector3d middle;
        double radius = 0;
    };

    /// A cone between two balls, in coordinates divided by `flat`.
    struct Bone {
        Bone(Vector3d from, double from_radius, Vector3d to, double to_radius);

        /// For each point, replaces its number in `distances` by the point's distance from the
        /// bone's flesh (negative inside) if that distance is smaller.
        WITH_WIDE_VECTORS void lower(Numbers& distances, const Block& points) const;

        Vector3d from, direction;
        double extent = 0;
        double radius = 0,
               growth = 0;  ///< The radius at the start, and its increase per unit of length.
        /// The tangent of the angle by which the surface's normals lean along the bone.
        double lean = 0;
        Ball ball;  ///< Contains the flesh.
    };
    /// A limb or its mirror image, with a box that contains its flesh.
    struct Part {
        std::size_t first = 0, last = 0;  ///< The range of the limb's bones.
        double softness = 0;
        Vector3d flat;
        SurfaceMesh::Box box;
    };

    void add(const Limb& limb, double side);
    void add_part(const Part& part, const Block& points, const SurfaceMesh::Box& box,
                  Numbers& sums) const;

    std::vector<Bone> bones_;
    std::vector<Part> parts_;
};

}  // namespace cascade
