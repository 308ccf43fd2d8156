// Shapes of several closed parts, such as tufts of hair or feathers.
#pragma once

#include "core/result.h"
#include "mesh/swept_shape.h"

#include <span>

namespace cascade {

/// A closed part of a shape.
struct ShapePart {
    SweptSurface surface;
    SweptNumber shade;  ///< May be empty.
};

/// Joins the parts. facets_for() chooses the facets of each part for `detail`. Fails as
/// facets_for() and swept_shape() do.
Result<TriangleMesh> mesh_of(std::span<const ShapePart> parts, const SweptDetail& detail);

}  // namespace cascade
