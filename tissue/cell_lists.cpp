// Reads places, finds neighbours, and makes the table of links that kernels read.
#include "tissue/cell_lists.h"

#include <algorithm>

namespace cascade {
namespace {

/// Cells are put in order again when this part of the links more than then has become far.
constexpr double far_part_to_order = 0.1;
/// Fewer cells are all near in memory.
constexpr std::size_t least_cells_to_order = 4096;

/// Calls `use(cell, place, radius)` for all cells in some state.
void each_place(const Tissue& tissue, const TissueSpecies& species, const std::vector<Field>& state,
                const auto& use) {
    with_number(tissue.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const Number* const x = state[species.place].origin<Number>();
        const Number* const y = state[species.place + 1].origin<Number>();
        const Number* const z = state[species.place + 2].origin<Number>();
        const Number* const radius = state[species.radius].origin<Number>();
        tissue.each_cell([&](std::size_t cell, std::int64_t at) {
            use(cell, Vector3d{x[at], y[at], z[at]}, static_cast<double>(radius[at]));
        });
    });
}

}  // namespace

CellLists::CellLists(const NeighbourRule& rule, double skin, double most_bytes,
                     const TissueSpecies& species, Team& team)
    : rule_(rule), skin_(skin), most_bytes_(most_bytes), species_(species), team_(team) {}

void CellLists::read(const Tissue& tissue, const std::vector<Field>& state) {
    places_.resize(tissue.count());
    radii_.resize(tissue.count());
    each_place(tissue, species_, state, [&](std::size_t cell, Vector3d place, double radius) {
        places_[cell] = place;
        radii_[cell] = std::max(0.0, radius);
    });
    double sum = 0;
    for (const std::uint32_t cell : tissue.by_number()) sum += radii_[cell];
    rule_.mean_radius = sum / static_cast<double>(std::max<std::size_t>(1, places_.size()));
}

void CellLists::begin_step(const Tissue& tissue) {
    read(tissue, tissue.species);
    watch_->begin_step(places_, radii_, rule_);
}

bool CellLists::wants_order(const Tissue& tissue) const {
    return is_disordered_ && tissue.count() >= least_cells_to_order;
}

void CellLists::put_in_order(Tissue& tissue) {
    read(tissue, tissue.species);
    tissue.rearrange(order_along_curve({places_, radii_, tissue.ranks()}), tissue.count());
    is_disordered_ = false;
    is_just_ordered_ = true;
}

bool CellLists::reach(const Tissue& tissue, const std::vector<Field>& state, double around) const {
    bool all = true;
    each_place(tissue, species_, state, [&](std::size_t cell, Vector3d place, double radius) {
        all = all && watch_->reaches(cell, place, radius, around);
    });
    return all;
}

void CellLists::end_step(const Tissue& tissue) {
    each_place(tissue, species_, tissue.species,
               [&](std::size_t cell, Vector3d place, double radius) {
                   watch_->look(cell, place, radius);
               });
}

Result<void> CellLists::build(const Tissue& tissue, const std::vector<Field>& state, bool is_full) {
    read(tissue, state);
    const double skin = is_full ? MovementWatch::full_skin : skin_;
    // In the list and in the table, where a few places are padding.
    const double bytes_of_link = sizeof(std::uint32_t) + 2 * sizeof(std::int16_t);
    auto lists = find_neighbours({places_, radii_, tissue.ranks()}, rule_, skin,
                                 most_bytes_ / bytes_of_link, team_);
    if (!lists) return tl::unexpected(lists.error());
    const double far_part = static_cast<double>(lists->far_links) /
                            static_cast<double>(std::max<std::size_t>(1, lists->neighbours.size()));
    if (is_just_ordered_) far_part_ = far_part;
    is_just_ordered_ = false;
    is_disordered_ = far_part > far_part_ + far_part_to_order;
    links_.assign({lists->ends, lists->neighbours}, tissue.layout(), tissue.precision());
    watch_->begin_lists(places_, radii_, rule_, skin);
    ++builds_;
    return {};
}

}  // namespace cascade
