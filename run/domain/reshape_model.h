// Finer and coarser triangles for a model, for `cascade mesh`.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// What to change, in this order.
struct Reshaping {
    int subdivide = 0;                    ///< How often (mesh/subdivide.h).
    std::optional<std::size_t> simplify;  ///< The number of triangles to leave (mesh/simplify.h).
    bool changes() const { return subdivide > 0 || simplify.has_value(); }
};

/// Changes the mesh. Returns sentences about what became of it. Fails if it would take more memory
/// than is free, and as subdivide() does. Throws std::bad_alloc. Meaningless if `cancel` became
/// true.
Result<std::vector<std::string>> reshape(SurfaceMesh& mesh, const Reshaping& how,
                                         const std::atomic<bool>& cancel);

}  // namespace cascade
