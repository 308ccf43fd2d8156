// The body of a volume: the surface around the cells in which the expression `body` of the picture
// block is above 0.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "mesh/surface_mesh.h"
#include "render/draw.h"
#include "run/domain/domain_mask.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"

#include <memory>
#include <span>

namespace cascade {

/// Makes the closed surface around the cells with values above 0, in the script's unit of length
/// (run/tissue/grown_body.h). Cells with NaN and cells outside of `mask` count as outside the body.
/// If `mask` is null, there is no mask. Triangles are as large as cells, or larger if the surface
/// would otherwise exceed the limit of implicit_surface(). The surface is empty if no value is
/// above 0. Throws std::bad_alloc.
std::shared_ptr<const SurfaceMesh> body_of(const Field& values, const DomainMask* mask,
                                           Boundaries boundary);

/// Interpolates the values of a volume's cells linearly at the points of a body. The result is a
/// field of one row in binary32. If the body has no points, the row contains a single NaN.
Field at_points(const Field& values, const SurfaceMesh& body, Boundaries boundary);

/// Draws a body. `colours` has one sRGB colour for each of its points. Throws std::bad_alloc.
Image draw_body(std::shared_ptr<const SurfaceMesh> body, std::span<const Colour> colours,
                const DrawOptions& options);

}  // namespace cascade
