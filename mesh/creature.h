// The example model: an animal with four legs, a long tail and round ears.
#pragma once

#include "core/result.h"
#include "mesh/implicit_surface.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <span>

namespace cascade {

/// A straight bone and the flesh around it, whose radius changes linearly from end to end.
struct Bone {
    Vector3d from, to;
    double from_radius = 0, to_radius = 0;
    double softness = 0;     ///< The length over which it blends with other bones.
    bool is_paired = false;  ///< It has a mirror image, with x negated.
    bool continues = false;  ///< In one limb with the bone before it: the nearer of the two counts.
};

/// The bones of the animal, which looks along +z, has y up, and stands on y = 0, about 1.5 high.
std::span<const Bone> creature_bones();

/// The logarithm of the sum over the limbs, which are chains of bones, of exp(−d / s), with the
/// distance d from a limb's flesh and its softness s: blobs as in J. F. Blinn, "A Generalization of
/// Algebraic Surface Drawing", ACM Transactions on Graphics 1(3), 1982. Positive inside.
double creature_function(Vector3d p);

/// The surface of the animal: one component with the topology of a sphere, standing on y = 0.
/// `edge` and failures are those of implicit_surface(); ears and tail need an edge of at most 0.06.
Result<SurfaceMesh> creature_mesh(double edge, const std::atomic<bool>& cancel);

}  // namespace cascade
