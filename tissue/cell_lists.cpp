// Reads positions, finds neighbours, and makes the table of links for kernels.
#include "tissue/cell_lists.h"

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// Cells are reordered when the fraction of far links has grown by more than this.
constexpr double far_part_to_order = 0.1;
/// The number of steps for which lists should stay valid if cells move as in the last step.
constexpr double steps_of_lists = 6;
constexpr double most_skin = 1;
/// The movement expected in a step, as a multiple of the movement in the last step. The expected
/// movement is limited to the fraction `part_of_skin` of the skin.
constexpr double expected_steps = 1.5, part_of_skin = 0.8;
/// The largest fraction of the available width that a skin may take. The rest is a margin for
/// rounding.
constexpr double part_of_room = 1 - 1e-6;
/// The smallest number of cells that is worth reordering. Fewer cells are always near each other in
/// memory.
constexpr std::size_t least_cells_to_order = 4096;

/// Calls `use(cell, place, radius)` for all cells, with their positions in this state.
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
    mean_radius_ = rule_.mean_radius;
    watch_->begin_step(places_, radii_, rule_);
}

bool CellLists::wants_order(const Tissue& tissue) const {
    return is_disordered_ && tissue.count() >= least_cells_to_order;
}

void CellLists::put_in_order(Tissue& tissue) {
    read(tissue, tissue.species);
    tissue.rearrange(order_along_curve({places_, radii_, tissue.ranks()}));
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

bool CellLists::reach(const Tissue& tissue, std::span<const std::uint32_t> cells) const {
    return std::all_of(cells.begin(), cells.end(), [&](std::uint32_t cell) {
        return watch_->reaches(cell, place_of(tissue, species_, cell),
                               tissue.value(species_.radius, cell), 0);
    });
}

void CellLists::end_step(Tissue& tissue) {
    each_place(tissue, species_, tissue.species,
               [&](std::size_t cell, Vector3d place, double radius) {
                   watch_->look(cell, place, radius);
                   tissue.restlessness[cell] = static_cast<float>(watch_->way_of(cell, place));
               });
}

/// A skin with which a cell's list stays valid for a few steps, derived from the cell's movement in
/// the last step. At least `least`.
double CellLists::skin_of(const Tissue& tissue, std::size_t cell, double least) const {
    const double wanted = steps_of_lists * double{tissue.restlessness[cell]};
    return std::max(least, std::min(most_skin, wanted));
}

/// The largest number of links for which the memory allows a list and a table of links. Padding
/// takes a few more entries of the table.
double CellLists::most_links() const {
    return most_bytes_ / (sizeof(std::uint32_t) + 2 * sizeof(std::int16_t));
}

Result<void> CellLists::build(const Tissue& tissue, const std::vector<Field>& state, bool is_full) {
    read(tissue, state);
    skins_.clear();
    const double least = is_full ? std::max(skin_, MovementWatch::full_skin) : skin_;
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        skins_.push_back(static_cast<float>(skin_of(tissue, cell, least)));
    }
    NeighbourSearch search({places_, radii_, tissue.ranks(), skins_}, rule_, 0);
    auto lists = find_neighbours(search, tissue.ranks(), most_links(), team_);
    if (!lists) return tl::unexpected(lists.error());
    kept_.start(std::move(*lists), std::move(search));
    watch_->begin_lists(places_, radii_, rule_, skins_);
    take(tissue, {});
    ++builds_;
    return {};
}

Result<void> CellLists::renew(const Tissue& tissue, std::span<const std::uint32_t> cells) {
    read(tissue, tissue.species);
    skins_.resize(tissue.count());
    std::vector<BoxedCell> marks;
    bool is_small_enough = true;
    for (const std::uint32_t cell : cells) {
        // The skin must not be wider than the boxes of the last search allow.
        const double radius = radii_[cell], extent = slack_of(rule_, 1, radius);
        const double room = kept_.widest() - std::max(rule_.reach * radius, rule_.near / 2);
        const double most = extent > 0 ? part_of_room * room / extent : most_skin;
        const double skin = std::min(most, skin_of(tissue, cell, skin_));
        is_small_enough = is_small_enough && skin >= skin_;
        skins_[cell] = static_cast<float>(skin);
        marks.push_back(
            boxed({places_, radii_, tissue.ranks(), {}}, cell, rule_, double{skins_[cell]}));
    }
    if (!is_small_enough || !kept_.renew(marks, tissue.ranks(), most_links())) {
        return build(tissue, tissue.species, false);
    }
    watch_->resize(tissue.count());
    for (const std::uint32_t cell : cells) {
        watch_->renew(cell, places_[cell], radii_[cell], rule_, double{skins_[cell]});
    }
    take(tissue, kept_.changed());
    return {};
}

Result<void> CellLists::renew_restless(const Tissue& tissue) {
    std::vector<std::uint32_t> restless;
    each_place(tissue, species_, tissue.species,
               [&](std::size_t cell, Vector3d place, double radius) {
                   // The movement for which the present list must still be valid. It is limited to
                   // a part of the skin, because even a new list at this position would not allow a
                   // longer movement.
                   const double way = std::min(expected_steps * double{tissue.restlessness[cell]},
                                               part_of_skin * double{skins_[cell]});
                   if (watch_->reaches(cell, place, radius, slack_of(rule_, way, radius))) return;
                   restless.push_back(static_cast<std::uint32_t>(cell));
               });
    if (restless.empty()) return {};
    return renew(tissue, restless);
}

/// Makes the table of links for kernels. Links::assign() describes `changed`.
void CellLists::take(const Tissue& tissue, const std::vector<bool>& changed) {
    const NeighbourLists& lists = kept_.lists();
    const double far_part = static_cast<double>(lists.far_links) /
                            static_cast<double>(std::max<std::size_t>(1, lists.neighbours.size()));
    if (is_just_ordered_) far_part_ = far_part;
    is_just_ordered_ = false;
    is_disordered_ = far_part > far_part_ + far_part_to_order;
    const bool is_same = std::exchange(layout_, tissue.layout()) == tissue.layout();
    links_.assign({lists.ends, lists.neighbours}, tissue.layout(), tissue.precision(),
                  is_same ? changed : std::vector<bool>());
}

}  // namespace cascade
