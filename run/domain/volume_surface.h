// Makes surfaces of formulas in space, which may read volumes: implicit(field("v.npy") - 0.5).
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "mesh/surface_mesh.h"
#include "run/domain/model_cells.h"

#include <atomic>

namespace cascade {

/// Makes the surface on which the formula of the model is 0. The formula is above 0 inside. If the
/// formula calls `field` without a position, the array of `field` fills the cube: the longest side
/// of the array is as long as the cube, and the other sides are centred. x runs along rows, y along
/// columns and z along slices. Such a surface is closed at the sides of the array, like a body
/// (run/tissue/grown_body.h). Triangles are as large as the smallest elements of all arrays, within
/// limits. Fails if a file cannot be read.
Result<SurfaceMesh> surface_of_formula(const ModelSettings& settings, const Literals& literals,
                                       const ModelAccess& access, const std::atomic<bool>& cancel);

}  // namespace cascade
