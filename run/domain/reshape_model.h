// Makes the triangles of a model finer or coarser, for the command `cascade mesh`.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The changes to be made. They are made in the order of the members.
struct Reshaping {
    int subdivide = 0;  ///< The number of subdivisions (mesh/subdivide.h).
    /// The wanted number of triangles (mesh/simplify.h). Empty: the mesh is not simplified.
    std::optional<std::size_t> simplify;
    bool changes() const { return subdivide > 0 || simplify.has_value(); }
};

/// Changes the mesh, and returns sentences about the result. Fails in the same cases as
/// subdivide(), and if there is not enough free memory. Throws std::bad_alloc. The result is
/// meaningless if `cancel` became true.
Result<std::vector<std::string>> reshape(SurfaceMesh& mesh, const Reshaping& how,
                                         const std::atomic<bool>& cancel);

}  // namespace cascade
