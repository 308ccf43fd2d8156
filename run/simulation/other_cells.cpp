// Makes a new environment for each grid. run/domain/cell_carrier.h transfers the values.
#include "run/simulation/other_cells.h"

#include "core/counted_cells.h"
#include "core/resample.h"
#include "lang/program/scaled_lengths.h"
#include "run/domain/field_values.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

Program coarser_program(const Script& script, const Program& fine, std::int64_t times) {
    Program result = script.coarser(fine.domain.coarse * times);
    for (std::uint32_t k = 0; k < result.stages.size(); ++k) {
        const auto& size = fine.stages[k].size;
        if (size && size->factor != 1) result = with_lengths(result, k, size->factor);
    }
    return result;
}

Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage) {
    const std::int64_t times = program.stages[stage].coarse;
    return times == 1 ? program : coarser_program(script, program, times);
}

std::unique_ptr<Environment> environment_in_cells(const Environment& known, Program program,
                                                  const CellCarrier& carrier,
                                                  TimeAccount* account) {
    auto runs = std::make_shared<const Program>(std::move(program));
    StagePlans plans(*runs, known.plans.options());
    const Grid grid = runs->domain.grid;
    auto made = std::make_unique<Environment>(known.script, std::move(runs), std::move(plans), grid,
                                              known.tools, account);
    made->files = known.files.mapped([&](const Field& plane) { return carrier.carried(plane); });
    return made;
}

std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, Program program,
                                             TimeAccount* account) {
    const auto carrier = carrier_to_wider(fine.grid, program.domain.grid);
    auto made = environment_in_cells(fine, std::move(program), *carrier, account);
    made->progress_note = fmt::format(", cells {} times as wide", made->program->domain.coarse);
    return made;
}

StageState carried_state(const StageState& state, const CellCarrier& carrier, double spacing) {
    StageState result;
    result.started = state.started;
    result.done = state.done;
    result.steps = state.steps;
    result.t = state.t;
    result.time = state.time;
    result.numbers = state.numbers;
    result.species_of_item = state.species_of_item;
    const auto carry_all = [&](const auto& planes, auto& into) {
        for (const Field& plane : planes)
            into.push_back(plane.empty() ? Field() : carrier.carried(plane));
    };
    const auto* const from = std::get_if<FieldState>(&state.values);
    if (from == nullptr) return result;
    FieldState& into = result.fields();
    carry_all(from->parameters, into.parameters);
    carry_all(from->species, into.species);
    if (!from->frozen.empty()) {
        into.frozen = carrier.carried(from->frozen);
        // `frozen` and `speed` are the last two items of a stage of fields.
        Field& flags = into.parameters[ItemId(into.parameters.size() - 2)];
        flags = to_field(into.frozen, flags.precision());
    }
    into.sides = from->sides;
    for (SideRules& rules : into.sides) {
        rules.spacing = spacing;
        for (std::size_t side = 0; side < side_count; ++side) {
            auto& values = rules.at[side].values;
            if (values) values = carrier.carried(*values, side);
        }
    }
    return result;
}

StageState on_grid(const StageState& state, const Grid& from, const Grid& to) {
    const std::int64_t before = from.longest_side(), now = to.longest_side();
    if (before == now) return StageState(state);
    const auto carrier = before > now ? carrier_to_wider(from, to)
                                      : carrier_to_finer(from, now / before, nullptr, nullptr);
    return carried_state(state, *carrier, to.spacing);
}

Field in_cells_of(const Simulation& simulation, std::uint32_t stage, ItemId item, Field values) {
    const Grid &domain = simulation.domain().grid, &own = simulation.domain(stage).grid;
    if (domain.longest_side() == own.longest_side()) return values;
    const auto carrier = carrier_to_wider(domain, own);
    if (item == simulation.domain().program->system_of(stage).frozen_item())
        return to_field(carrier->carried(to_mask(values)), values.precision());
    // Where new values equal the values that pictures show, the difference is 0, so these cells
    // keep their own values exactly.
    Field result(simulation.state(stage).field(item));
    const Field& shown = simulation.field(stage, item);
    values.visit([&]<typename Number>(Plane<Number>& plane) {
        for_each_cell([](Number& to, Number from) { to -= from; }, plane, shown.plane<Number>());
        const Field change = carrier->carried(values);
        for_each_cell([](Number& to, Number by) { to += by; }, result.plane<Number>(),
                      change.plane<Number>());
    });
    return result;
}

void keep_frozen(Field& values, const Mask& frozen, const Field& start) {
    if (frozen.empty()) return;
    values.visit([&]<typename Number>(Plane<Number>& plane) {
        for_each_cell(
            [](Number& value, Number before, bool is_frozen) {
                if (is_frozen) value = before;
            },
            plane, start.plane<Number>(), frozen);
    });
}

std::string note_of_cells(const Program& program) {
    if (program.domain.coarse == 1) return "";
    return fmt::format(" (on the grid with cells {} times as wide)", program.domain.coarse);
}

}  // namespace cascade
