// Bakes the model, and then each simplified level. A texel of a level takes its values from the
// nearest position on the model.
#include "run/pictures/model_maps.h"

#include "core/run_control.h"
#include "export/bake.h"
#include "export/level_samples.h"
#include "export/levels.h"
#include "export/refine.h"
#include "mesh/simplify.h"
#include "run/pictures/model_occlusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <utility>

namespace cascade {

namespace {

static_assert(ModelFileOptions::most_texels == BakeOptions::largest_texture);

constexpr std::int64_t least_texels = 16;  ///< The smallest side of a level's maps.

/// Says that the maps are far finer than the cells. Returns an empty string if they are not.
std::string describe_spare_texels(std::int64_t side, double texels_of_cell) {
    constexpr double most = 16, enough = 4;  // In texels along a cell.
    const double along = std::sqrt(texels_of_cell);
    if (!(along > most)) return {};
    const auto needed = static_cast<std::uint64_t>(static_cast<double>(side) * enough / along);
    return fmt::format(
        "a cell is {:.0f} texels wide in maps of {} texels: '--bake {}' shows as much detail, "
        "and more cells would show more",
        along, side, std::bit_ceil(needed));
}

struct BakedLevel {
    SurfaceMesh mesh;
    Bake maps;
};

class LevelBaker {
public:
    LevelBaker(const MappedSurface& surface, const PaintedCells& painted,
               const ModelFileOptions& options, Team& team)
        : surface_(surface), painted_(painted), options_(options), team_(team) {}

    /// Bakes the model and its levels.
    Result<std::deque<BakedLevel>> bake_all() {
        std::deque<BakedLevel> levels;
        auto first = bake_model();
        if (!first) return tl::unexpected(first.error());
        levels.push_back(*std::move(first));
        if (options_.levels == 1) return levels;
        const FineSurface fine(surface_.mesh, surface_.filter, painted_, surface_.displaced);
        for (int k = 1; k < options_.levels; ++k) {
            const SurfaceMesh& finer = levels.back().mesh;
            auto simple =
                simplify(finer, finer.triangles.size() / triangles_to_level, {}, never_cancelled);
            if (!simple) return tl::unexpected(simple.error());
            if (2 * simple->mesh.triangles.size() > finer.triangles.size()) break;
            auto level = bake_level(std::move(simple->mesh), fine,
                                    std::max(options_.bake >> k, least_texels));
            if (!level) return tl::unexpected(level.error());
            levels.push_back(*std::move(level));
        }
        return levels;
    }

private:
    static BakeOptions size_of(std::int64_t side) {
        BakeOptions size;
        size.width = size.height = side;
        return size;
    }

    Result<BakedLevel> bake_model() {
        PaintedCells painted = painted_;
        if (surface_.displaced) painted.heights = {};
        auto maps = bake(surface_.mesh, surface_.filter, painted, size_of(options_.bake), team_,
                         never_cancelled);
        if (!maps) return tl::unexpected(maps.error());
        return BakedLevel{surface_.displaced ? surface_.displaced->mesh : surface_.mesh,
                          *std::move(maps)};
    }

    Result<BakedLevel> bake_level(SurfaceMesh mesh, const FineSurface& fine, std::int64_t side) {
        auto texture = unwrap(mesh, side, team_, never_cancelled);
        if (!texture) return tl::unexpected(texture.error());
        mesh.texture = *std::move(texture);
        const auto painter = [&] { return std::make_unique<LevelSamples>(mesh, fine); };
        auto maps = bake(mesh, painter, size_of(side), team_, never_cancelled);
        if (!maps) return tl::unexpected(maps.error());
        maps->is_cut = is_cut(painted_.material[MaterialPart::opacity]);
        return BakedLevel{std::move(mesh), *std::move(maps)};
    }

    const MappedSurface& surface_;
    const PaintedCells& painted_;
    const ModelFileOptions& options_;
    Team& team_;
};

}  // namespace

std::vector<std::filesystem::path> map_paths_of_level(const std::filesystem::path& path,
                                                      std::size_t level, const MapSet& said,
                                                      bool displaces, MapFormat format) {
    MapSet maps = said;
    if (level > 0 || displaces) maps.heights = false;
    if (displaces) maps.normals = false;
    if (level > 0) maps.normals = true;
    return map_paths(path_of_level(path, level), maps, format);
}

Result<WrittenFiles> write_model_maps(const std::filesystem::path& path,
                                      const MappedSurface& surface, const ModelLook& look,
                                      const ModelFileOptions& options, const PngTexts& texts,
                                      Team& team) {
    PaintedCells painted = look.painted();
    std::vector<float> occlusion;
    if (!look.heights.empty()) {
        occlusion =
            model_occlusion(surface.mesh, surface.cells, surface.filter, look.heights, team);
        painted.material[MaterialPart::occlusion] = occlusion;
    }
    const auto levels = LevelBaker(surface, painted, options, team).bake_all();
    if (!levels) return tl::unexpected(levels.error());
    WrittenFiles written;
    const Bake& finest = levels->front().maps;
    written.warnings = finest.warnings;
    const auto& doubts = look.material.doubts;
    written.warnings.insert(written.warnings.end(), doubts.begin(), doubts.end());
    const double texels = finest.covered * static_cast<double>(options.bake * options.bake);
    std::string doubt =
        describe_spare_texels(options.bake,
                              texels / static_cast<double>(surface.cells.places.size()));
    if (!doubt.empty()) written.warnings.push_back(std::move(doubt));
    std::vector<MappedModel> models;
    for (const BakedLevel& level : *levels) models.push_back({level.mesh, level.maps});
    for (std::size_t k = 0; k < models.size(); ++k) {
        const auto file = path_of_level(path, k);
        const auto rest = std::span(models).subspan(k, k == 0 ? models.size() : 1);
        if (auto done = write_maps(file, rest, texts, options.map_format); !done) {
            return tl::unexpected(done.error());
        }
        const auto paths = map_paths(file, models[k].maps.maps, options.map_format);
        written.paths.insert(written.paths.end(), paths.begin(), paths.end());
    }
    return written;
}

}  // namespace cascade
