// Direction fields given by directions at a few positions, and their smoothing.
#pragma once

#include "core/parallel.h"
#include "surface/direction_field.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// A direction that is given at one position of the surface: the position nearest to a point in
/// space.
struct KeyDirection {
    Vector3d position;
    Vector3d direction;
};

/// Each plane gets the direction of the nearest key, transported along the shortest path of planes
/// as if the surface were unfolded along this path. In components without a key, the key nearest in
/// space is projected into the first plane of the component and transported from there. Ignores
/// keys that are not finite, are perpendicular to the surface, or share a plane with an earlier
/// one. Without keys the field is directions() of zero vectors. The field jumps where regions of
/// different keys meet, so use smoothed_directions() next. The result is undefined if `cancel`
/// became true.
std::vector<Vector3d> key_directions(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                     std::span<const KeyDirection> keys, DirectionKind kind,
                                     const std::atomic<bool>& cancel);

/// Smooths directions by diffusion over the surface, with parallel transport between planes, and
/// scales the result to length 1. This corresponds to convolution with a Gaussian of standard
/// deviation `length`, in units of the model. A length of 0 changes nothing. Lines are added with
/// doubled angles. A direction stays unchanged where the diffused directions cancel out. The result
/// is the same with any number of threads. It is undefined if `cancel` became true.
std::vector<Vector3d> smoothed_directions(const TangentPlanes& planes,
                                          std::span<const Vector3d> field, DirectionKind kind,
                                          double length, Team& team,
                                          const std::atomic<bool>& cancel);

}  // namespace cascade
