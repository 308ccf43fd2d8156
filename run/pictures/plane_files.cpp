// Calls export/, which makes the maps.
#include "run/pictures/plane_files.h"

#include "core/enough_memory.h"
#include "core/parallel.h"
#include "export/height_occlusion.h"
#include "export/plane_maps.h"
#include "run/pictures/model_files.h"
#include "run/pictures/plane_look.h"

#include <fmt/format.h>

namespace cascade {

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
