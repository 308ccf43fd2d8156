// Gives each species its number among those that solvers step.
#include "run/stage/stage_state.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "run/domain/field_values.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

StageState empty_state(const System& system) {
    StageState state;
    state.numbers.assign(system.item_count(), 0);
    state.fields.resize(system.item_count());
    state.species_of_item.resize(system.item_count());
    const auto species = system.species();
    for (const SpeciesId id : species.ids()) state.species_of_item[species[id]] = id;
    state.species.resize(species.size());
    return state;
}

std::optional<CellCounts> counts_of_cells(const StageState& state) {
    if (!state.tissue) return std::nullopt;
    const Tissue& tissue = *state.tissue;
    return CellCounts{static_cast<std::int64_t>(tissue.count()), tissue.births, tissue.deaths};
}

const Field& StageState::field(ItemId item) const {
    const auto id = species_of_item[item];
    if (tissue) return id ? tissue->species[id->index()] : tissue->kept[item.index()];
    return id ? species[id->index()] : fields[item];
}

const Mask& StageState::frozen_cells() const { return tissue ? tissue->frozen() : frozen; }

void StageState::go_to(std::int64_t complete, double time_then) {
    steps = complete;
    t = time_then;
    if (changing_sides.empty()) return;
    const FlushDenormals environment;
    const PlaneLayout& layout = species.front().layout();
    const SpeciesPlanes present = planes_of(species);
    for (const SpeciesId s : ids_below<SpeciesId>(sides.size())) {
        set_side_values(changing_sides, s, {steps, t}, present, layout, {{0, layout.row_count()}},
                        sides[s.index()]);
    }
}

void set_item(StageState& state, const System& system, ItemId item, Field values) {
    const auto species = state.species_of_item[item];
    const bool is_frozen = item == system.frozen_item();
    if (Tissue* const tissue = state.tissue.get()) {
        (species ? tissue->species[species->index()] : tissue->kept[item.index()]) =
            std::move(values);
        tissue->pad();
        if (is_frozen) tissue->freeze_by(item.index());
        return;
    }
    CHECK(species || !state.fields[item].empty(), "only an item that varies has a field");
    if (is_frozen) state.frozen = to_mask(values);
    (species ? state.species[species->index()] : state.fields[item]) = std::move(values);
}

std::string describe_place(const Stage& stage, const StageState& state) {
    const std::string step = fmt::format("step {}", state.steps);
    if (stage.time.open_end) return step;
    if (!stage.time.has_duration()) return fmt::format("{} of {}", step, stage.iterations);
    if (!stage.time.duration) return fmt::format("{}, t = {:.6g}", step, state.t);
    return fmt::format("{}, t = {:.6g} of {:.6g}", step, state.t, *stage.time.duration);
}

}  // namespace cascade
