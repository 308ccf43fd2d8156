// An animal of our own to grow patterns on: four legs, a long tail and round ears.
#pragma once

#include "core/result.h"
#include "mesh/implicit_surface.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <span>

namespace cascade {

/// A straight bone and the flesh around it, the thickness of which changes evenly from end to end.
struct Bone {
    Vector3d from, to;
    double from_radius = 0, to_radius = 0;
    double softness = 0;     ///< The length over which it blends with others.
    bool is_paired = false;  ///< There is another one on the other side, x mirrored.
    bool continues =
        false;  ///< Goes on where the bone before it ends: of the two the nearer counts.
};

/// The animal looks along +z, y points up, and it stands on y = 0, about 1.5 high.
std::span<const Bone> creature_bones();

/// The logarithm of the sum over the limbs, which are chains of bones, of exp(−d / s), d being the
/// distance from a limb's flesh and s its softness: blobs as in J. F. Blinn, "A Generalization of
/// Algebraic Surface Drawing", ACM Transactions on Graphics 1(3), 1982, along segments. Above 0
/// inside.
double creature_function(Vector3d p);

/// Its surface: one component, closed like a sphere, with the lowest point on y = 0. `edge` as in
/// implicit_surface(), whose failures it passes on; the ears and the tail need 0.06 or less.
Result<SurfaceMesh> creature_mesh(double edge, const std::atomic<bool>& cancel);

}  // namespace cascade
