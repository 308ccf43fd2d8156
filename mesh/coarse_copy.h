// Coarse copies of surfaces, for work that ignores their finest details.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

struct CoarseCopy {
    SurfaceMesh mesh;
    /// For each point of the original, the point of the copy into which it has merged.
    std::vector<std::uint32_t> merged;
};

/// The surface after short edges have been collapsed until most are about as long as `edge`.
/// Components, handles and boundaries remain. Fails as half_edges() does. Throws std::bad_alloc.
Result<CoarseCopy> coarse_copy(const SurfaceMesh& mesh, double edge);

}  // namespace cascade
