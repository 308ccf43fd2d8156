// Raises the points of a refined mesh, and casts rays among its triangles.
#include "run/pictures/model_occlusion.h"

#include "core/check.h"
#include "export/painted_cells.h"
#include "run/pictures/refined_model.h"
#include "mesh/normals.h"
#include "render/ray_caster.h"
#include "render/samples.h"
#include "run/domain/creased_mesh.h"
#include "surface/blur_cells.h"

#include <cmath>
#include <limits>

namespace cascade {

namespace {

constexpr std::uint32_t rays = 64;
/// The distance from the surface at which rays begin, as a fraction of the model's longest side.
constexpr float occlusion_clearance = 1e-4F;

}  // namespace

std::vector<float> model_occlusion(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                   const CellFilter& filter, std::span<const float> heights,
                                   Team& team) {
    CHECK(heights.size() == cells.places.size(), "each cell has a height");
    std::vector<float> finite(heights.begin(), heights.end());
    for (float& height : finite) height = std::isfinite(height) ? height : 0;
    const DrawnMesh drawn = creased_mesh(
        raised_model(refined_for_colours(mesh, cells), mesh, filter, finite, team).mesh);
    const RayCaster caster(drawn.mesh);
    const CornerNormals normals = corner_normals(mesh);
    const auto nearby = static_cast<float>(cell_spacing(cells) * drawn.scale);
    const auto seen_from = [&](std::size_t cell) {
        const SurfacePlace& place = cells.places[cell];
        const Vector3d outwards = normals.at(mesh, place);
        const Vector3d top =
            position_of(mesh, place) + outwards * static_cast<double>(finite[cell]);
        const Vector3 normal = single(outwards);
        // The cell, at its height, may be slightly above or below the raised triangles.
        Vector3 begin = single((top - drawn.middle) * drawn.scale) + normal * nearby;
        const auto hit = caster.nearest({begin, -normal});
        begin = begin - normal * (hit && hit->distance < 2 * nearby ? hit->distance : nearby);
        begin = begin + normal * occlusion_clearance;
        const Frame frame = frame_of(normal);
        std::uint32_t open = 0;
        for (std::uint32_t ray = 0; ray < rays; ++ray) {
            const DiscPoint disc = on_disc(even_point(ray, 0, 0));
            const float up = std::sqrt(std::max(0.0F, 1 - disc.x * disc.x - disc.y * disc.y));
            const Vector3 way = frame.tangent * disc.x + frame.bitangent * disc.y + normal * up;
            if (!caster.is_blocked({begin, way}, std::numeric_limits<float>::infinity())) ++open;
        }
        return static_cast<float>(open) / static_cast<float>(rays);
    };
    std::vector<float> seen(cells.places.size());
    team.run([&](int thread) {
        const RowRange mine =
            split_rows(static_cast<std::int64_t>(seen.size()), thread, team.size());
        for (auto cell = static_cast<std::size_t>(mine.begin);
             cell < static_cast<std::size_t>(mine.end); ++cell) {
            seen[cell] = seen_from(cell);
        }
    });
    return seen;
}

}  // namespace cascade
