// What is kept of a stage is what starting it would not give again.
#include "run/session/kept_state.h"

#include "run/session/kept_cells.h"
#include "run/stage/stage_time.h"
#include "tissue/tissue.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace cascade {
namespace {

std::size_t bytes_of_field(const Field& field) {
    return static_cast<std::size_t>(field.layout().size()) * bytes_of(field.precision());
}

std::vector<Field> copies(std::span<const Field> fields) {
    std::vector<Field> result;
    for (const Field& field : fields) result.push_back(field.clone());
    return result;
}

std::size_t bytes_of_record(const TissueRecord& record) {
    std::size_t values = 0;
    for (const auto* of : {&record.species, &record.stiffest, &record.kept}) {
        for (const std::vector<double>& each : *of) values += each.size();
    }
    return sizeof(double) * values + sizeof(std::uint32_t) * 2 * record.numbers.size();
}

/// The kept stage that stage `k` of a program goes on from; null if there is none. Cells that crawl
/// do not go on as a field, nor the other way round.
const KeptStage* counterpart(const Program& program, std::uint32_t k, const KeptState& state) {
    if (k >= state.stages.size()) return nullptr;
    const KeptStage& kept = state.stages[k];
    if ((kept.cells != nullptr) != program.system_of(k).cells.has_value()) return nullptr;
    const bool is_elsewhere =
        kept.name != program.stages[k].name &&
        std::any_of(program.stages.begin(), program.stages.end(),
                    [&](const Stage& stage) { return stage.name == kept.name; });
    return is_elsewhere ? nullptr : &kept;
}

bool is_over(const Program& program, std::uint32_t k, const StageState& state,
             const StageMoment& moment) {
    const Stage& stage = program.stages[k];
    if (!stage.time.has_duration()) return moment.steps >= stage.iterations;
    return moment.t >= duration_of(stage, program.system_of(k), state);
}

/// Are two expressions the same but for the places where they were written?
bool is_same(const Formula& first, const Formula& second) {
    return std::equal(first.nodes.begin(), first.nodes.end(), second.nodes.begin(),
                      second.nodes.end(), [](const Node& a, const Node& b) {
                          return a.kind == b.kind && a.function == b.function &&
                                 std::equal(a.reads().begin(), a.reads().end(), b.reads().begin(),
                                            b.reads().end());
                      });
}

/// Files are read again.
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

/// Do two programs grow on the same model, but for its seed? False if there is none.
bool have_same_model(const Program& before, const Program& after) {
    const auto& first = before.domain.model;
    const auto& second = after.domain.model;
    if (!first || !second) return false;
    return first->shape == second->shape && first->path == second->path &&
           first->sizes == second->sizes && is_same(first->implicit, second->implicit) &&
           first->cells == second->cells && first->count == second->count &&
           first->laplacian == second->laplacian && first->unit == second->unit &&
           first->stance == second->stance && is_same(first->directions, second->directions) &&
           first->stretch == second->stretch;
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
    for (const KeptStage& stage : stages) {
        for (const Field& field : stage.moment.species) bytes += bytes_of_field(field);
        for (const auto& [name, field] : stage.painted) {
            bytes += field.empty() ? 0 : bytes_of_field(field);
        }
        if (stage.cells) bytes += bytes_of_record(*stage.cells);
        if (!stage.moment.memory) continue;
        for (const Field& field : stage.moment.memory->watch.last()) bytes += bytes_of_field(field);
    }
    return bytes;
}

KeptState keep(const Simulation& simulation, const std::vector<PaintedNames>& painted) {
    KeptState kept;
    const Program& program = simulation.program();
    for (std::uint32_t k = 0; k < program.stages.size() && simulation.state(k).started; ++k) {
        const StageState& state = simulation.state(k);
        const System& system = program.system_of(k);
        KeptStage stage;
        stage.name = program.stages[k].name;
        for (const ItemId item : system.species())
            stage.species.emplace_back(system.item_name(item));
        stage.moment = {state.tissue ? std::vector<Field>() : copies(state.species),
                        state.steps,
                        state.t,
                        state.done,
                        state.condition_met,
                        StageMoment::Memory{state.time, state.watch}};
        if (state.tissue) {
            stage.cells = std::make_shared<const TissueRecord>(state.tissue->record());
            for (const ItemId item : system.items()) {
                stage.items.emplace_back(system.item_name(item));
            }
            for (const std::string& name : painted[k]) stage.painted.emplace(name, Field());
            kept.stages.push_back(std::move(stage));
            continue;
        }
        for (const std::string& name : painted[k]) {
            const auto item = find_item(system, name);
            const bool is_own = item && !system.is_species(*item);
            stage.painted.emplace(name, is_own ? state.field(*item).clone() : Field());
        }
        kept.stages.push_back(std::move(stage));
    }
    return kept;
}

Result<std::vector<PaintedNames>> go_on(Simulation& simulation, const Simulation* before,
                                        const KeptState& state, Continuation how,
                                        const std::atomic<bool>& cancel, std::size_t count) {
    const Program& program = simulation.program();
    std::vector<PaintedNames> painted;
    for (std::uint32_t k = 0; k < std::min(count, program.stages.size()); ++k) {
        const KeptStage* const kept = counterpart(program, k, state);
        if (kept == nullptr) break;
        if (auto started = simulation.start_stage(k, cancel); !started) {
            return tl::unexpected(started.error());
        }
        const System& system = program.system_of(k);
        const bool is_current = k + 1 == state.stages.size();
        const bool is_same_run = how == Continuation::same;
        const bool is_anew = !is_same_run && is_current && kept->moment.steps == 0;
        StageMoment moment;
        moment.steps = kept->moment.steps;
        moment.t = kept->moment.t;
        moment.done = kept->moment.done && (is_same_run || !is_current ||
                                            is_over(program, k, simulation.state(k), kept->moment));
        moment.condition_met = kept->moment.condition_met && moment.done;
        PaintedNames& still_painted = painted.emplace_back();
        if (kept->cells) {
            for (const auto& [name, field] : kept->painted) still_painted.insert(name);
            if (is_anew && still_painted.empty()) continue;
            if (is_same_run) {
                simulation.restore_cells(k, *kept->cells, moment);
            } else if (auto gone = go_on_with_cells(simulation, before, k, *kept, moment); !gone) {
                return tl::unexpected(gone.error());
            }
            continue;
        }
        for (const ItemId item : system.species()) {
            const std::string_view name = system.item_name(item);
            const auto old = std::find(kept->species.begin(), kept->species.end(), name);
            const bool is_kept = old != kept->species.end() &&
                                 (!is_anew || kept->painted.contains(std::string(name)));
            const auto& own = simulation.state(k).field(item);
            const auto index = static_cast<std::size_t>(old - kept->species.begin());
            moment.species.push_back(is_kept ? kept->moment.species[index].clone() : own.clone());
        }
        if (is_same_run && kept->moment.memory) moment.memory.emplace(*kept->moment.memory);
        simulation.restore(k, std::move(moment));
        for (const auto& [name, field] : kept->painted) {
            const auto item = find_item(system, name);
            if (!item) continue;
            const bool is_own = !system.is_species(*item);
            if (is_own && (program.stages[k].uniform[*item] || field.empty())) continue;
            if (is_own) simulation.set_field(k, *item, field.clone());
            still_painted.insert(name);
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
