// The trefoil knot, a surface on which no two directions are alike.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// Tubes of this radius and more meet themselves.
inline constexpr double most_knot_radius = 0.6;

/// A tube around the curve (sin φ + 2 sin 2φ, cos φ − 2 cos 2φ, −sin 3φ). Its rings do not twist
/// against the curve, but for the turn that closes the tube, which is spread over its length.
/// Texture: along the curve, and around the tube. `radius` is below `most_knot_radius`; `edge` as
/// for the shapes (mesh/shapes.h). Fails on others.
Result<SurfaceMesh> knot_mesh(double radius, double edge);

}  // namespace cascade
