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

/// The changes, applied in this order.
struct Reshaping {
    int subdivide = 0;                    ///< How many times (mesh/subdivide.h).
    std::optional<std::size_t> simplify;  ///< The resulting number of triangles (mesh/simplify.h).
    bool changes() const { return subdivide > 0 || simplify.has_value(); }
};

/// Changes the mesh. Returns sentences about the result. Fails if it would take more memory than is
/// free, and as subdivide() does. Throws std::bad_alloc. Meaningless if `cancel` became true.
Result<std::vector<std::string>> reshape(SurfaceMesh& mesh, const Reshaping& how,
                                         const std::atomic<bool>& cancel);

}  // namespace cascade
