// Computes the metric of a domain's surface, which operators and pictures use.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "surface/parameter_surface.h"

#include <optional>
#include <vector>

namespace cascade {

/// Returns the function that maps parameters to positions on the surface. The function refers to
/// `surface`.
SurfaceFunction function_of(const SurfaceSettings& surface);

/// The length of one unit in coordinates of the surface, at t = 0. Empty if the script sets neither
/// a unit nor an extent.
std::optional<double> unit_of(const SurfaceSettings& surface, const Grid& grid);

/// The planes of the metric, indexed by MetricPlane. Empty if the domain has no surface or if its
/// cells count as squares. If the surface is singular at some point, fails with a message that
/// names the point.
Result<std::vector<Field>> metric_planes(const Program& program);

}  // namespace cascade
