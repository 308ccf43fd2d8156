// Surfaces of formulas of space that may read volumes: implicit(field("v.npy") - 0.5).
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "mesh/surface_mesh.h"
#include "run/domain/model_cells.h"

#include <atomic>

namespace cascade {

/// The surface where the formula of the model is 0, with values above 0 inside. `field` without a
/// position fills the cube with its array, the longest side from side to side and the others in the
/// middle: x along rows, y along columns, z along slices. The sides of the array then close the
/// surface, as for a body (run/tissue/grown_body.h). Triangles are as large as elements of the
/// largest array, within limits. Fails on an unreadable file.
Result<SurfaceMesh> surface_of_formula(const ModelSettings& settings, const Literals& literals,
                                       const ModelAccess& access, const std::atomic<bool>& cancel);

}  // namespace cascade
