// Reads places, finds neighbours, and makes the table of links that kernels read.
#include "tissue/cell_lists.h"

#include <algorithm>

namespace cascade {
namespace {

/// Cells are put in order again when this part of the links more than then has become far.
constexpr double far_part_to_order = 0.1;
/// Fewer cells are all near in memory.
constexpr std::size_t least_cells_to_order = 4096;

}  // namespace

CellLists::CellLists(const NeighbourRule& rule, double skin, double most_bytes,
                     const TissueSpecies& species, Team& team)
    : rule_(rule), skin_(skin), most_bytes_(most_bytes), species_(species), team_(team) {}

void CellLists::read(const Tissue& tissue, const std::vector<Field>& state) {
    places_.clear();
    radii_.clear();
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        places_.push_back(place_in(state, tissue, species_, cell));
        radii_.push_back(std::max(0.0, value_in(state[species_.radius], tissue, cell)));
    }
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
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        if (!watch_->reaches(cell, place_in(state, tissue, species_, cell),
                             value_in(state[species_.radius], tissue, cell), around)) {
            return false;
        }
    }
    return true;
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
