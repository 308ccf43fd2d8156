// Chooses the number of facets for each part separately.
#include "mesh/shape_parts.h"

namespace cascade {

Result<TriangleMesh> mesh_of(std::span<const ShapePart> parts, const SweptDetail& detail) {
    TriangleMesh mesh;
    for (const ShapePart& part : parts) {
        const Result<SweptFacets> facets = facets_for(part.surface, detail);
        if (!facets) return tl::unexpected(facets.error());
        const Result<TriangleMesh> added = swept_shape(part.surface, *facets, part.shade);
        if (!added) return tl::unexpected(added.error());
        append(*added, mesh);
    }
    return mesh;
}

}  // namespace cascade
