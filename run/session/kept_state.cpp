// Stores only values that could not be computed again by starting the stage.
#include "run/session/kept_state.h"

#include "lang/program/stage_kinds.h"
#include "run/simulation/stage_view.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/stage_time.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

namespace {

// CellChange makes crawling cells from a stored state, for the changed stage that continues with
// them.

using Values = std::vector<double>;

class CellChange {
public:
    CellChange(Simulation& simulation, std::uint32_t stage, const KeptStage& kept)
        : simulation_(simulation),
          stage_(stage),
          kept_(kept),
          kept_cells_(*std::get<RecordedCells>(kept.record.values)),
          record_(kept_cells_) {}

    Result<void> make(const Simulation* before, const StageMoment& moment) {
        take_values();
        restore(moment);
        const auto now = values_of_start(simulation_.view(stage_));
        if (now.empty() && !missing_.empty() && !record_.numbers.empty()) {
            return failure(fmt::format("'{}' cannot be added now, because cells born since stage "
                                       "'{}' began have no starting value for it",
                                       system().item_name(missing_[0]), kept_.name),
                           "go back to the start of the stage, and change it there");
        }
        if (now.empty()) return {};
        for (const ItemId item : missing_) values_of(item) = now[item.index()];
        const auto then = before != nullptr ? values_of_start(before->view(stage_of(*before)))
                                            : std::vector<Values>();
        for (const ItemId item : system().items()) {
            if (is_changed(item, now, then)) values_of(item) = now[item.index()];
        }
        restore(moment);
        return {};
    }

private:
    void restore(const StageMoment& moment) {
        cascade::restore(simulation_, stage_,
                         {moment, std::make_shared<const TissueRecord>(record_)});
    }

    const System& system() const { return simulation_.domain().program->system_of(stage_); }
    Values& values_of(ItemId item) {
        const auto species = system().species_of(item);
        return species ? record_.species[species->index()] : record_.kept[item.index()];
    }

    /// Returns the index of an item among all stored items, or the number of stored items if the
    /// item is not stored.
    std::size_t kept_item(ItemId item) const {
        const auto found = std::ranges::find(kept_.items, system().item_name(item));
        return static_cast<std::size_t>(found - kept_.items.begin());
    }

    /// Returns the stored values of the item with this name. Returns no values if the item was
    /// uniform.
    Values kept_values(ItemId item) const {
        const auto found = std::ranges::find(kept_.species, system().item_name(item));
        const auto species = static_cast<std::size_t>(found - kept_.species.begin());
        if (species < kept_.species.size()) return kept_cells_.species[species];
        const std::size_t other = kept_item(item);
        return other < kept_.items.size() ? kept_cells_.kept[other] : Values();
    }

    void take_values() {
        record_.species.assign(system().species_count(), {});
        record_.kept.assign(system().item_count(), {});
        for (const ItemId item : system().items()) {
            const bool varies = !simulation_.domain().stage(stage_).uniform[item];
            if (!system().is_species(item) && !varies) continue;
            values_of(item) = kept_values(item);
            if (!values_of(item).empty()) continue;
            missing_.push_back(item);
            values_of(item).resize(record_.numbers.size());
        }
        const std::size_t frozen = system().frozen_item().index();
        record_.frozen.reset();
        if (!record_.kept[frozen].empty()) record_.frozen = frozen;
        // The lengths of steps are chosen anew.
        record_.stiffest.clear();
        record_.time.control = {};
        record_.time.stiffness = 0;
        record_.time.estimated_at = -1;
    }

    /// Returns the index of the stored stage in its program.
    std::uint32_t stage_of(const Simulation& before) const {
        const auto& stages = before.domain().program->stages;
        const auto found = std::ranges::find(stages, kept_.name, &Stage::name);
        return static_cast<std::uint32_t>(found - stages.begin());
    }

    /// Whether the start of the stage gives a parameter other values now than before.
    bool is_changed(ItemId item, const std::vector<Values>& now,
                    const std::vector<Values>& then) const {
        const auto& restarts = system().cells->restarts;
        const bool starts_again = item < restarts.next() && !restarts[item].nodes.empty();
        if (system().is_species(item) || starts_again || now[item.index()].empty()) return false;
        if (kept_.painted.contains(std::string(system().item_name(item)))) return false;
        const std::size_t old = kept_item(item);
        return old < then.size() && then[old] != now[item.index()];
    }

    Simulation& simulation_;
    std::uint32_t stage_;
    const KeptStage& kept_;
    const TissueRecord& kept_cells_;
    TissueRecord record_;
    std::vector<ItemId> missing_;  ///< Items for which there are no values.
};

/// Gives the stored cells to a started stage of a changed program. A quantity takes the values of
/// the stored quantity with the same name. If no values are stored, the quantity is computed from
/// the start of the stage, at the present positions of the cells. A parameter that was not painted
/// is also computed from the start if the start now gives it other values than in `before`, which
/// may be null. A value that restarts at divisions is changed only by divisions. Fails if a
/// quantity has neither a stored value nor a start.
Result<void> go_on_with_cells(Simulation& simulation, const Simulation* before, std::uint32_t stage,
                              const KeptStage& kept, const StageMoment& moment) {
    return CellChange(simulation, stage, kept).make(before, moment);
}

/// Returns the stored stage from which stage `k` of a program continues, or null if there is none.
/// A stage of crawling cells never continues from a stage of fields, and a stage of fields never
/// continues from a stage of crawling cells.
const KeptStage* counterpart(const Program& program, std::uint32_t k, const KeptState& state) {
    if (k >= state.stages.size()) return nullptr;
    const KeptStage& kept = state.stages[k];
    if (kept.record.is_of_cells() != is_of_cells(program, k)) return nullptr;
    const bool is_elsewhere =
        kept.name != program.stages[k].name &&
        std::any_of(program.stages.begin(), program.stages.end(),
                    [&](const Stage& stage) { return stage.name == kept.name; });
    return is_elsewhere ? nullptr : &kept;
}

bool is_over(const Program& program, std::uint32_t k, const StageState& state,
             const StageMoment& then) {
    const Stage& stage = program.stages[k];
    if (!stage.time.has_duration()) return then.steps >= stage.iterations;
    return then.t >= duration_of(stage, program.system_of(k), state);
}

/// Returns the moment from which stage `k` of a program goes on.
StageMoment moment_of(const Simulation& simulation, std::uint32_t k, const KeptStage& kept,
                      Continuation how, bool is_current) {
    if (how == Continuation::same) return kept.record;
    // The lengths of steps are chosen anew, so the state of the step control is not copied.
    StageMoment moment;
    moment.steps = kept.record.steps;
    moment.t = kept.record.t;
    moment.done = kept.record.done && (!is_current || is_over(*simulation.domain().program, k,
                                                              simulation.state(k), kept.record));
    moment.condition_met = kept.record.condition_met && moment.done;
    return moment;
}

/// Gives the stored fields to a started stage: all painted items and, unless the stage starts anew,
/// the species. Returns the names of the painted items.
PaintedNames go_on_with_fields(Simulation& simulation, std::uint32_t k, const KeptStage& kept,
                               StageMoment moment, bool is_anew) {
    const Program& program = *simulation.domain().program;
    const System& system = program.system_of(k);
    const auto& before = std::get<RecordedFields>(kept.record.values);
    PaintedNames still_painted;
    RecordedFields fields;
    for (const ItemId item : recorded_items(program, k)) {
        const std::string name(system.item_name(item));
        const bool is_species = system.is_species(item);
        const bool was_painted = kept.painted.contains(name);
        const auto old = before.find(name);
        const bool is_kept = old != before.end() && (was_painted || (is_species && !is_anew));
        if (!is_kept && !is_species) continue;
        const Field& values = is_kept ? old->second : simulation.state(k).field(item);
        fields.emplace(name, values.clone());
        if (was_painted) still_painted.insert(name);
    }
    restore(simulation, k, {std::move(moment), std::move(fields)});
    return still_painted;
}

/// Whether two expressions are the same except for their source locations.
bool is_same(const Formula& first, const Formula& second) {
    return std::equal(first.nodes.begin(), first.nodes.end(), second.nodes.begin(),
                      second.nodes.end(), [](const Node& a, const Node& b) {
                          return a.kind == b.kind && a.function == b.function &&
                                 std::equal(a.reads().begin(), a.reads().end(), b.reads().begin(),
                                            b.reads().end());
                      });
}

/// Expressions that read files never count as the same, because the files are read again.
bool is_same(const std::optional<Formula>& first, const std::optional<Formula>& second) {
    const auto reads = [](const Node& node) { return node.calls(Function::field); };
    if (first && std::ranges::any_of(first->nodes, reads)) return false;
    return first.has_value() == second.has_value() && (!first || is_same(*first, *second));
}

bool is_same(const std::optional<DirectionSettings>& first,
             const std::optional<DirectionSettings>& second) {
    if (!first || !second) return first.has_value() == second.has_value();
    return first->kind == second->kind && first->numbers == second->numbers &&
           is_same(first->height, second->height) && first->smoothing == second->smoothing;
}

/// Whether two programs have the same model, apart from its seed. False if one of them has no
/// model.
bool have_same_model(const Program& before, const Program& after) {
    const auto& first = before.domain.model;
    const auto& second = after.domain.model;
    if (!first || !second) return false;
    return first->shape == second->shape && first->path == second->path &&
           first->sizes == second->sizes && is_same(first->implicit, second->implicit) &&
           first->cells == second->cells && first->count == second->count &&
           first->laplacian == second->laplacian && first->unit == second->unit &&
           first->extent == second->extent && first->stance == second->stance &&
           is_same(first->directions, second->directions) && first->stretch == second->stretch;
}

}  // namespace

std::optional<ItemId> find_item(const System& system, std::string_view name) {
    for (const ItemId item : system.items()) {
        if (system.item_name(item) == name) return item;
    }
    return std::nullopt;
}

std::size_t KeptState::bytes() const {
    std::size_t bytes = 0;
    for (const KeptStage& stage : stages) bytes += stage.record.bytes();
    return bytes;
}

KeptState keep(const Simulation& simulation, const std::vector<PaintedNames>& painted) {
    KeptState kept;
    const Program& program = *simulation.domain().program;
    for (std::uint32_t k = 0; k < program.stages.size() && simulation.state(k).started; ++k) {
        const System& system = program.system_of(k);
        KeptStage& stage = kept.stages.emplace_back();
        stage.name = program.stages[k].name;
        stage.painted = painted[k];
        stage.record = record_of(simulation.state(k), program, k, stage.painted);
        for (const ItemId item : system.items()) stage.items.emplace_back(system.item_name(item));
        for (const ItemId item : system.species())
            stage.species.emplace_back(system.item_name(item));
    }
    return kept;
}

Result<std::vector<PaintedNames>> go_on(Simulation& simulation, const Simulation* before,
                                        const KeptState& state, Continuation how,
                                        const std::atomic<bool>& cancel, std::size_t count) {
    const Program& program = *simulation.domain().program;
    std::vector<PaintedNames> painted;
    for (std::uint32_t k = 0; k < std::min(count, program.stages.size()); ++k) {
        const KeptStage* const kept = counterpart(program, k, state);
        if (kept == nullptr) break;
        if (auto started = simulation.start_stage(k, cancel); !started) {
            return tl::unexpected(started.error());
        }
        const bool is_current = k + 1 == state.stages.size();
        const bool is_same_run = how == Continuation::same;
        const bool is_anew = !is_same_run && is_current && kept->record.steps == 0;
        StageMoment moment = moment_of(simulation, k, *kept, how, is_current);
        if (!kept->record.is_of_cells()) {
            painted.push_back(go_on_with_fields(simulation, k, *kept, std::move(moment), is_anew));
            continue;
        }
        painted.push_back(kept->painted);
        if (is_anew && kept->painted.empty()) continue;
        if (is_same_run) {
            restore(simulation, k,
                    {std::move(moment), std::get<RecordedCells>(kept->record.values)});
        } else if (auto gone = go_on_with_cells(simulation, before, k, *kept, moment); !gone) {
            return tl::unexpected(gone.error());
        }
    }
    return painted;
}

bool have_same_cells(const Program& before, const Program& after) {
    const DomainSettings& first = before.domain;
    const DomainSettings& second = after.domain;
    if (first.seed != second.seed || first.precision != second.precision) return false;
    for (const Stage& stage : before.stages) {
        for (const Stage& other : after.stages) {
            if (other.name == stage.name && other.coarse != stage.coarse) return false;
        }
    }
    if (first.model || second.model) return have_same_model(before, after);
    const bool has_mask = first.mask.has_value();
    if (has_mask != second.mask.has_value()) return false;
    if (has_mask && !is_same(first.mask->formula, second.mask->formula)) return false;
    return first.grid.width == second.grid.width && first.grid.height == second.grid.height &&
           first.grid.depth == second.grid.depth;
}

}  // namespace cascade
