// Numbers the species among the planes that solvers step, and moves stages in time.
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
    state.species_of_item.resize(system.item_count());
    const auto species = system.species();
    for (const SpeciesId id : species.ids()) state.species_of_item[species[id]] = id;
    if (system.cells) {
        state.values = TissueState();
    } else {
        state.fields().parameters.resize(system.item_count());
        state.fields().species.resize(species.size());
    }
    return state;
}

std::optional<CellCounts> counts_of_cells(const StageState& state) {
    const Tissue* const tissue = state.tissue();
    if (tissue == nullptr) return std::nullopt;
    return CellCounts{static_cast<std::int64_t>(tissue->count()), tissue->births, tissue->deaths};
}

Tissue* StageState::tissue() const {
    const auto* const cells = std::get_if<TissueState>(&values);
    return cells != nullptr ? cells->tissue.get() : nullptr;
}

std::shared_ptr<const TissueGround> StageState::ground() const {
    const auto* const cells = std::get_if<TissueState>(&values);
    return cells != nullptr ? cells->ground : nullptr;
}

std::vector<Field>& StageState::species() {
    Tissue* const cells = tissue();
    return cells != nullptr ? cells->species : fields().species;
}

const std::vector<Field>& StageState::species() const {
    const Tissue* const cells = tissue();
    return cells != nullptr ? cells->species : fields().species;
}

const Field& StageState::field(ItemId item) const {
    if (const auto id = species_of_item[item]) return species()[id->index()];
    const Tissue* const cells = tissue();
    return cells != nullptr ? cells->kept[item.index()] : fields().parameters[item];
}

const Mask& StageState::frozen() const {
    const Tissue* const cells = tissue();
    return cells != nullptr ? cells->frozen() : fields().frozen;
}

std::span<const SideRules> StageState::sides() const {
    const auto* const own = std::get_if<FieldState>(&values);
    return own != nullptr ? std::span<const SideRules>(own->sides) : std::span<const SideRules>();
}

void StageState::go_to(std::int64_t complete, double time_then) {
    steps = complete;
    t = time_then;
    auto* const own = std::get_if<FieldState>(&values);
    if (own == nullptr || own->changing_sides.empty()) return;
    const FlushDenormals environment;
    const PlaneLayout& layout = own->species.front().layout();
    const SpeciesPlanes present = planes_of(own->species);
    for (const SpeciesId s : ids_below<SpeciesId>(own->sides.size())) {
        set_side_values(own->changing_sides, s, {steps, t}, present, layout,
                        {{0, layout.row_count()}}, own->sides[s.index()]);
    }
}

void take_values(StageState& state, const Program& program, std::uint32_t stage,
                 std::span<const ItemId> items, std::span<Field> planes) {
    Tissue* const tissue = state.tissue();
    for (std::size_t k = 0; k < items.size(); ++k) {
        const ItemId item = items[k];
        if (program.stages[stage].uniform[item]) {
            state.numbers[item] = planes[k].number_at(0, 0);
        } else if (const auto id = state.species_of_item[item]) {
            state.species()[id->index()] = std::move(planes[k]);
        } else {
            (tissue != nullptr ? tissue->kept[item.index()] : state.fields().parameters[item]) =
                std::move(planes[k]);
        }
    }
    if (tissue != nullptr) tissue->pad();
    const ItemId frozen = program.system_of(stage).frozen_item();
    if (program.stages[stage].uniform[frozen]) return;
    if (tissue != nullptr) tissue->freeze_by(frozen.index());
    else state.fields().frozen = to_mask(state.field(frozen));
}

std::string describe_place(const Stage& stage, const StageState& state) {
    const std::string step = fmt::format("step {}", state.steps);
    if (stage.time.open_end) return step;
    if (!stage.time.has_duration()) return fmt::format("{} of {}", step, stage.iterations);
    if (!stage.time.duration) return fmt::format("{}, t = {:.6g}", step, state.t);
    return fmt::format("{}, t = {:.6g} of {:.6g}", step, state.t, *stage.time.duration);
}

}  // namespace cascade
