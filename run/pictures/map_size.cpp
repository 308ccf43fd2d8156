// Computes N for a map of N × N texels from the fraction of the texels that the cells cover
// together.
#include "run/pictures/map_size.h"

#include "atlas/texture_facts.h"
#include "run/pictures/model_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace cascade {

namespace {

double side_needed(double texels_per_cell, std::int64_t cells, double covered) {
    return texels_per_cell * std::sqrt(static_cast<double>(cells) / covered);
}

double covered_by(const ModelCells& model, const MeshTexture& texture) {
    const SurfaceMesh mesh = mesh_in_files(model, texture);
    // If a texture covers almost no texel, other code refuses or reports it.
    return std::max(texture_facts(mesh).covered, 1e-4);
}

}  // namespace

std::int64_t map_side(double texels_per_cell, std::int64_t cells, double covered) {
    const double least = std::ceil(side_needed(texels_per_cell, cells, covered));
    return static_cast<std::int64_t>(
        std::bit_ceil(static_cast<std::uint64_t>(std::clamp(least, 1.0, 0x1p40))));
}

MapSize map_size_for(double texels_per_cell, const Simulation& simulation,
                     const MeshTexture& texture) {
    constexpr std::int64_t most = ModelFileOptions::most_texels;
    std::int64_t wanted = 0;
    double cells_along = 0;  // The number of cells side by side that are as wide as the map.
    if (const auto& model = simulation.domain().model) {
        const double covered = covered_by(*model->cells, texture);
        const auto count = static_cast<std::int64_t>(model->cells->count());
        wanted = map_side(texels_per_cell, count, covered);
        cells_along = side_needed(1, count, covered);
    } else {
        cells_along = static_cast<double>(simulation.domain().grid.longest_side());
        wanted = std::max<std::int64_t>(1, std::llround(texels_per_cell * cells_along));
    }
    MapSize size;
    size.side = std::min(wanted, most);
    size.is_short = wanted > most;
    const double along = static_cast<double>(size.side) / cells_along;
    size.remark = size.is_short ? fmt::format(
                                      "the largest maps, of {} texels, have {:.2g} texels along a "
                                      "cell; '--texels-per-cell {:g}' needs {}",
                                      most, along, texels_per_cell, wanted)
                                : fmt::format("maps of {} texels: a cell is {:.2g} texels wide",
                                              size.side, along);
    return size;
}

}  // namespace cascade
