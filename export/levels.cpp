// Simplifies level by level, and averages values of merged points.
#include "export/levels.h"

#include "core/file_format.h"
#include "core/write_encoded.h"
#include "export/glb.h"
#include "mesh/simplify.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace cascade {

namespace {

/// For each point, a third of the area of the triangles around it.
std::vector<double> areas_of_points(const SurfaceMesh& mesh) {
    std::vector<double> areas(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double third = mesh.area(t) / 3;
        for (const std::uint32_t point : mesh.triangles[t]) areas[point] += third;
    }
    return areas;
}

/// Means over the points that have merged into each point.
class MergedMeans {
public:
    MergedMeans(const Simplified& simplified, std::vector<double> areas)
        : simplified_(simplified), areas_(std::move(areas)) {}

    /// The means of `number(point)`. Ignores numbers that are not finite, unless none of them is
    /// finite.
    template <typename Take>
    std::vector<float> of(const Take& number) const {
        const std::size_t count = simplified_.points.size();
        std::vector<double> sums(count), areas(count);
        for (std::size_t p = 0; p < areas_.size(); ++p) {
            const auto value = static_cast<double>(number(p));
            if (!std::isfinite(value)) continue;
            sums[simplified_.merged[p]] += value * areas_[p];
            areas[simplified_.merged[p]] += areas_[p];
        }
        std::vector<float> means(count);
        for (std::size_t p = 0; p < count; ++p) {
            means[p] = areas[p] > 0 ? static_cast<float>(sums[p] / areas[p])
                                    : number(simplified_.points[p]);
        }
        return means;
    }

private:
    const Simplified& simplified_;
    std::vector<double> areas_;
};

ModelLevel level_below(const ModelLevel& finer, Simplified simplified) {
    const MergedMeans means(simplified, areas_of_points(finer.mesh));
    ModelLevel level;
    if (!finer.colours.empty()) {
        level.colours.resize(simplified.points.size());
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<float> lights =
                means.of([&](std::size_t p) { return light_of(shown(finer.colours[p])[c]); });
            for (std::size_t p = 0; p < lights.size(); ++p) {
                level.colours[p][c] = stored_of(lights[p]);
            }
        }
    }
    for (const Channel& channel : finer.channels) {
        level.channels.push_back(
            {channel.name, means.of([&](std::size_t p) { return channel.values[p]; })});
    }
    level.mesh = std::move(simplified.mesh);
    return level;
}

}  // namespace

Result<std::vector<ModelLevel>> levels_of(ModelLevel finest, int count, double pattern_length,
                                          const std::atomic<bool>& cancel) {
    std::vector<ModelLevel> levels;
    levels.push_back(std::move(finest));
    for (int k = 1; k < count && !cancel; ++k) {
        const ModelLevel& finer = levels.back();
        const std::size_t triangles = finer.mesh.triangles.size();
        auto simplified = simplify(finer.mesh, triangles / triangles_to_level,
                                   {finer.colours, pattern_length}, cancel);
        if (!simplified) return tl::unexpected(simplified.error());
        // If simplification could not remove enough triangles, because the topology needs nearly
        // all of them, this is the last level.
        if (2 * simplified->mesh.triangles.size() > triangles) break;
        levels.push_back(level_below(finer, *std::move(simplified)));
    }
    return levels;
}

std::filesystem::path path_of_level(const std::filesystem::path& path, std::size_t level) {
    if (level == 0) return path;
    std::filesystem::path name = path.stem();
    name += fmt::format("_lod{}", level);
    name += path.extension();
    return path.parent_path() / name;
}

namespace {

/// The bytes of a file that contains all levels.
Result<std::string> encode_all(std::span<const ModelLevel> levels) {
    std::vector<GlbLook> looks(levels.size());
    std::vector<GlbLevel> models;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        looks[k].colours = levels[k].colours;
        models.push_back({levels[k].mesh, looks[k]});
    }
    return encode_glb(models);
}

}  // namespace

Result<std::vector<std::filesystem::path>> write_levels(const std::filesystem::path& path,
                                                        std::span<const ModelLevel> levels) {
    std::vector<std::filesystem::path> paths;
    const Vector3d origin = origin_of_file(path, levels.front().mesh);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        paths.push_back(path_of_level(path, k));
        const bool has_all = k == 0 && can_hold(path, FormatTrait::levels);
        const Result<void> done =
            has_all ? write_encoded(path, [&] { return encode_all(levels); })
                    : write_model(paths.back(), levels[k].mesh, levels[k].results(), origin);
        if (!done) return tl::unexpected(done.error());
    }
    return paths;
}

}  // namespace cascade
