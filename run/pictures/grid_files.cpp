// Scales bodies and passes them to the code that writes levels of detail. Maps are made in export/.
#include "run/pictures/grid_files.h"

#include "core/enough_memory.h"
#include "core/parallel.h"
#include "core/run_control.h"
#include "export/height_occlusion.h"
#include "export/levels.h"
#include "export/plane_maps.h"
#include "run/pictures/model_files.h"
#include "run/pictures/plane_look.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

namespace {

Result<WrittenFiles> write_levels_of(const std::filesystem::path& path, const SurfaceMesh& body,
                                     const Grid& grid, const PointResults& results, int levels) {
    ModelLevel finest{body,
                      {results.colours.begin(), results.colours.end()},
                      {results.channels.begin(), results.channels.end()}};
    const double longest = grid.spacing * static_cast<double>(grid.longest_side());
    for (Vector3d& point : finest.mesh.points) point = point * longest;
    const auto all = levels_of(std::move(finest), levels, 2 * grid.spacing, never_cancelled);
    if (!all) return tl::unexpected(all.error());
    auto paths = write_levels(path, *all);
    if (!paths) return tl::unexpected(paths.error());
    return WrittenFiles{*std::move(paths),
                        remarks_of_origin(path, origin_of_file(path, all->front().mesh))};
}

}  // namespace

Result<WrittenFiles> write_body(const std::filesystem::path& path, const SurfaceMesh& body,
                                const Grid& grid, const PointResults& results, int levels) {
    if (body.points.empty()) {
        return failure(
            fmt::format("'{}' is not written, because the body is empty: its formula is "
                        "nowhere above 0",
                        path.string()));
    }
    return enough_memory_for([&] { return write_levels_of(path, body, grid, results, levels); },
                             "cannot write '" + path.string() + "': there is not enough memory");
}

Result<WrittenFiles> write_plane(const std::filesystem::path& path, const PlaneLook& look,
                                 const ModelFileOptions& options, const PngTexts& texts) {
    const auto write = [&]() -> Result<WrittenFiles> {
        Team team(hardware_threads());
        PaintedCells painted = look.painted();
        std::vector<float> occlusion;
        if (!look.heights.empty()) {
            occlusion = height_occlusion(look.cells, look.heights, team);
            painted.material[MaterialPart::occlusion] = occlusion;
        }
        const MaterialMaps maps =
            bake_plane(look.cells, painted, texture_size(look.cells, options.bake), team);
        const auto done = write_maps(path, plane_mesh(look.cells), maps, texts, options.map_format);
        if (!done) return tl::unexpected(done.error());
        return WrittenFiles{map_paths(path, maps.maps, options.map_format), look.material.doubts};
    };
    return enough_memory_for(write, fmt::format("there is not enough memory for maps of {} texels",
                                                options.bake));
}

}  // namespace cascade
