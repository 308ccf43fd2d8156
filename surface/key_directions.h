// Directions along a surface that a few places say, and the smoothing of directions.
#pragma once

#include "core/parallel.h"
#include "surface/direction_field.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// A vector at the place of the surface that is nearest to a point in space.
struct KeyDirection {
    Vector3d position;
    Vector3d direction;
};

/// Each plane takes the direction of the nearest key, carried along the shortest way from plane to
/// plane as if the surface were unfolded there; on components without a key, that of the key
/// nearest in space, brought into the first plane of the component and carried on. Keys that are
/// not finite, stand upright on the surface, or share a plane with an earlier one are left out;
/// without keys the field is that of no vectors. Where keys disagree directions jump:
/// `smoothed_directions` is the next step, as with values at key positions. Means nothing if
/// `cancel` became true.
std::vector<Vector3d> key_directions(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                     std::span<const KeyDirection> keys, DirectionKind kind,
                                     const std::atomic<bool>& cancel);

/// Diffuses directions over the surface, each carried into its neighbours' planes, as if spread by
/// a Gaussian of standard deviation `length`, in units of the model, and brings them to length 1
/// again; 0 changes nothing. Lines are added with their angles doubled. Where directions cancel out
/// they stay what they were. The same on any number of threads; means nothing if `cancel` became
/// true.
std::vector<Vector3d> smoothed_directions(const TangentPlanes& planes,
                                          std::span<const Vector3d> field, DirectionKind kind,
                                          double length, Team& team,
                                          const std::atomic<bool>& cancel);

}  // namespace cascade
