// The surface of a domain, for operators and pictures.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "surface/parameter_surface.h"

#include <vector>

namespace cascade {

/// The map of a domain's surface. It refers to `surface`.
SurfaceFunction function_of(const SurfaceSettings& surface);

/// A plane for each MetricPlane, in their order, or none if the domain has no surface or its cells
/// count as squares. Fails where the surface is singular and names the position.
Result<std::vector<Field>> metric_planes(const Program& program);

}  // namespace cascade
