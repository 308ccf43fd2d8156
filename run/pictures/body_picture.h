// The body of a volume: the surface around the cells where the picture block's `body` is above 0.
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

/// Whether pictures of the script show a body. --slice and --flat show a slice instead.
bool draws_body(const Script& script, const PictureRequest& request);

/// The closed surface around the cells whose values are above 0, in script lengths
/// (run/tissue/grown_body.h). NaN and cells outside of `mask`, which may be null, are not inside.
/// Its triangles are larger than cells where it would exceed implicit_surface()'s limit. Without
/// points if no value is above 0. Throws std::bad_alloc.
std::shared_ptr<const SurfaceMesh> body_of(const Field& values, const DomainMask* mask,
                                           Boundaries boundary);

/// The values of a volume's cells, interpolated linearly to the points of a body: one row of
/// binary32, or a single NaN if there are none.
Field at_points(const Field& values, const SurfaceMesh& body, Boundaries boundary);

/// Draws a body with these colours (sRGB) at its points. Throws std::bad_alloc.
Image draw_body(std::shared_ptr<const SurfaceMesh> body, std::span<const Colour> colours,
                const DrawOptions& options);

}  // namespace cascade
