// If there are more cells, each of them appears smaller, so it gets fewer facets.
#include "run/pictures/shown_cells.h"

#include "run/pictures/tissue_picture.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

/// The largest distance, in pixels, between facets and their shapes. It is also the default of
/// pictures.
constexpr double shown_detail = 0.5;

/// Returns how many pixels long a length of 1 is in the pictures for which meshes are made.
double pixels_for(std::size_t copies) {
    constexpr double most = 512, least = 64;
    constexpr double copies_of_most = 1000;
    return std::clamp(most * std::sqrt(copies_of_most / static_cast<double>(copies + 1)), least,
                      most);
}

}  // namespace

ShownCells shown_cells(const DrawnCells& cells, const SurfaceSource* surface) {
    ShownCells shown;
    shown.count = cells.count;
    shown.skin = cells.skin;
    shown.extent = cells.extent;
    shown.is_on_model = surface != nullptr && surface->model;
    shown.is_on_body = surface != nullptr && surface->body;
    Instances copies = instances_of(cells, pixels_for(cells.placements.size()), shown_detail);
    if (!shown.is_on_model) lay_flat(copies);
    std::vector<std::uint32_t> order(copies.placements.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    const auto mesh_of = [&](std::uint32_t k) { return copies.placements[k].mesh; };
    std::ranges::stable_sort(order, {}, mesh_of);
    shown.ends.assign(copies.meshes.size(), 0);
    for (const std::uint32_t k : order) {
        ++shown.ends[mesh_of(k)];
        shown.placements.push_back(copies.placements[k]);
        shown.cells.push_back(static_cast<std::uint32_t>(cells.cells[k]));
    }
    std::partial_sum(shown.ends.begin(), shown.ends.end(), shown.ends.begin());
    shown.meshes = std::move(copies.meshes);
    return shown;
}

}  // namespace cascade
