// Blurs the values of all cells, and then reads them at the cells of the level.
#include "run/pictures/nested_tiling.h"

#include "core/run_control.h"
#include "export/refine.h"
#include "mesh/normals.h"
#include "picture/srgb.h"
#include "surface/blur_cells.h"
#include "surface/nested_order.h"
#include "surface/retile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

class NestedTiling {
public:
    NestedTiling(const SurfaceMesh& mesh, const SurfaceCells& cells, const ModelLook& look,
                 std::span<const Channel> channels, Team& team)
        : mesh_(mesh), cells_(cells), look_(look), channels_(channels), team_(team) {
        for (std::size_t k = 0; k < cells.places.size(); ++k) {
            const Colour light = light_of(shown(look.colour_of(k, cells.places[k])));
            for (std::size_t c = 0; c < 3; ++c) lights_[c].push_back(light[c]);
        }
    }

    Result<std::vector<ModelLevel>> levels(int count) {
        std::vector<std::uint32_t> order;
        if (count > 1) order = nested_order(cells_);
        std::vector<ModelLevel> levels;
        std::vector<std::uint32_t> kept(cells_.places.size());
        std::iota(kept.begin(), kept.end(), 0u);
        for (int k = 0; k < count; ++k) {
            if (k > 0) {
                kept.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(
                                                               kept.size() / triangles_to_level));
                std::sort(kept.begin(), kept.end());
            }
            auto level = level_of(kept, k == 0 ? 0 : std::exp2(k) / 2);
            if (!level) return tl::unexpected(level.error());
            // The topology may need nearly all remaining points. Further levels would then hardly
            // be smaller.
            if (k > 0 && 2 * level->mesh.triangles.size() > levels.back().mesh.triangles.size()) {
                break;
            }
            levels.push_back(*std::move(level));
        }
        return levels;
    }

private:
    /// Returns the numbers of all cells, blurred by `sigma` distances between cells. Numbers that
    /// are not finite are left out. If only such numbers are near a cell, the cell keeps its own
    /// number.
    std::vector<float> blurred(const std::vector<float>& numbers, double sigma) const {
        if (sigma == 0) return numbers;
        // For each cell, the sum of the numbers and the sum of their weights.
        std::vector<float> sums;
        for (const float number : numbers) {
            const bool counts = std::isfinite(number);
            sums.push_back(counts ? number : 0);
            sums.push_back(counts ? 1.0F : 0.0F);
        }
        blur_cells(cells_, sigma, 2, sums, team_);
        std::vector<float> means = numbers;
        constexpr float least = 1e-3F;
        for (std::size_t k = 0; k < means.size(); ++k) {
            if (sums[2 * k + 1] > least) means[k] = sums[2 * k] / sums[2 * k + 1];
        }
        return means;
    }

    /// Makes a level whose points are the cells `kept`, which are in ascending order. The values
    /// are blurred by `sigma` distances between cells.
    Result<ModelLevel> level_of(const std::vector<std::uint32_t>& kept, double sigma) const {
        std::vector<SurfacePlace> places;
        for (const std::uint32_t cell : kept) places.push_back(cells_.places[cell]);
        auto made = retile(mesh_, places, never_cancelled);
        if (!made) return tl::unexpected(made.error());
        const auto at_points = [&](const std::string& name, const std::vector<float>& numbers) {
            const std::vector<float> of_all = blurred(numbers, sigma);
            std::vector<float> of_kept;
            for (const std::uint32_t cell : kept) of_kept.push_back(of_all[cell]);
            return attribute_of(*made, name, of_kept);
        };
        ModelLevel level;
        level.colours = colours_at_points(at_points);
        for (const Channel& channel : channels_) {
            level.channels.push_back(at_points(channel.name, channel.values));
        }
        if (look_.displaces) {
            displace(made->mesh, point_normals(made->mesh), at_points("", look_.heights).values);
        }
        level.mesh = std::move(made->mesh);
        return level;
    }

    template <typename AtPoints>
    std::vector<Colour> colours_at_points(const AtPoints& at_points) const {
        std::vector<Colour> colours;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<float> of_points = at_points("", lights_[c]).values;
            colours.resize(of_points.size());
            for (std::size_t p = 0; p < of_points.size(); ++p) {
                colours[p][c] = stored_of(std::clamp(of_points[p], 0.0F, 1.0F));
            }
        }
        return colours;
    }

    const SurfaceMesh& mesh_;
    const SurfaceCells& cells_;
    const ModelLook& look_;
    std::span<const Channel> channels_;
    Team& team_;
    /// Red, green and blue of all cells, as linear light.
    std::array<std::vector<float>, 3> lights_;
};

}  // namespace

Result<std::vector<ModelLevel>> nested_tiling(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                              const ModelLook& look,
                                              std::span<const Channel> channels, int count,
                                              Team& team) {
    return NestedTiling(mesh, cells, look, channels, team).levels(count);
}

}  // namespace cascade
