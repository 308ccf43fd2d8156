// Starting values are computed in the order of the plans, and sides after them.
#include "run/simulation/stage_start.h"

#include "core/floating_point.h"
#include "core/side_cells.h"
#include "run/domain/field_values.h"
#include "run/domain/metric_planes.h"
#include "run/simulation/stage_view.h"
#include "run/stage/bind_side.h"
#include "run/stage/plan_runner.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace cascade {
namespace {

void start_varying_items(const StageView& view, StageState& state) {
    const StepPlan& plan = view.environment().plans->start(view.number());
    std::vector<Field> values = view.evaluate(plan);
    for (std::size_t r = 0; r < values.size(); ++r) {
        const ItemId item = plan.results[r];
        const auto species = state.species_of_item[item];
        if (view.stage().uniform[item]) {
            state.numbers[item] = values[r].number_at(0, 0);
        } else if (species) {
            state.species[species->index()] = std::move(values[r]);
        } else {
            if (item == view.system().frozen_item()) state.frozen = to_mask(values[r]);
            state.fields[item] = std::move(values[r]);
        }
    }
}

/// Do rows and columns meet at an angle other than a right one beside a side with a flux?
bool is_sheared_at(const Environment& here, Side side, SideKind kind) {
    if (here.metric.empty() || kind != SideKind::flux) return false;
    const auto at = [&](MetricPlane plane, std::int64_t offset) {
        return here.metric[static_cast<std::size_t>(plane)].visit(
            [&](const auto& cells) { return double{cells.origin()[offset]}; });
    };
    const PlaneLayout layout(here.grid);
    const SideCells cells = SideCells::of_rows(layout, side, {0, layout.row_count()});
    for (std::int64_t k = 0; k < cells.count; ++k) {
        const std::int64_t offset = SideCells::offset(layout, side, k);
        const double across = std::abs(at(MetricPlane::inverse_12, offset));
        if (across > 1e-3 * std::abs(at(MetricPlane::inverse_22, offset))) return true;
    }
    return false;
}

/// Values of sides come from formulas that may read any starting value. A value that is the same
/// along the side is kept as a number. While values of sides are computed, the boundary of the
/// domain holds.
Result<void> find_sides(const StageView& view, StageState& state) {
    const Environment& here = view.environment();
    const std::uint32_t k = view.number();
    std::vector<SideRules> found;
    std::vector<ChangingSide> changing_sides;
    for (const auto& settings : view.stage().sides) {
        const SpeciesId species(found.size());
        SideRules rules;
        rules.spacing = here.grid.spacing;
        for (std::size_t side = 0; side < side_count; ++side)
            rules.at[side].kind = settings[side].kind;
        for (std::size_t side = 0; side < side_count; ++side) {
            SideRule& rule = rules.at[side];
            if (!rule.has_value()) continue;
            const SidePlans value =
                plan_side(*here.program, settings[side], static_cast<Side>(side), k);
            if (is_sheared_at(here, static_cast<Side>(side), rule.kind)) {
                return failure(
                    fmt::format(
                        "stage '{}': {} has a flux at the side {}, where the surface is sheared",
                        view.stage().name, species_name(view.system(), species.index()),
                        side_names[side]),
                    "a flux needs rows and columns that meet at right angles; fixed(…) does not");
            }
            if (value.changes) {
                changing_sides.push_back(bind_side(value, species, static_cast<Side>(side),
                                                   here.kernels->interpreted(), view.context(),
                                                   *here.team));
                continue;
            }
            const Field values = std::move(view.evaluate(value.each)[0]);
            rule.value = values.number_at(0, 0);
            if (is_same_everywhere(values)) continue;
            rule.values = std::make_shared<const SideValues>(
                SideValues{0, values_beside(values, static_cast<Side>(side))});
        }
        found.push_back(rules);
    }
    state.sides = std::move(found);
    state.changing_sides = std::move(changing_sides);
    state.go_to(state.steps, state.t);
    return {};
}

Result<void> check_speed(const StageView& view) {
    const Environment& here = view.environment();
    const ItemId item = view.system().speed_item();
    double slowest = view.state().numbers[item];
    if (!view.stage().uniform[item]) slowest = smallest(view.state().fields[item], here.inside());
    if (slowest > 0 && std::isfinite(slowest)) return {};
    const std::string text = with_number(here.precision(), [&](auto zero) {
        return fmt::format("{}", static_cast<decltype(zero)>(slowest));
    });
    return failure(fmt::format("stage '{}': its speed is {}, but a time step must be above 0",
                               view.stage().name, text));
}

}  // namespace

void start_uniform_items(const StageView& view, StageState& state) {
    // On a grid of one cell.
    const StepPlan plan = plan_uniform_start(view.program(), view.number());
    const Grid one{1, 1, Boundary::periodic};
    const Environment& here = view.environment();
    const std::vector<Field> values =
        run_plan(plan, here.kernels->interpreted_on(one), view.context(), one, *here.team);
    for (std::size_t r = 0; r < values.size(); ++r) {
        state.numbers[plan.results[r]] = values[r].number_at(0, 0);
    }
}

Result<void> start_stage(const Environment& environment, std::span<StageState> states,
                         std::uint32_t stage) {
    const TimeAccount::Scope spent(environment.account, Spent::starting, stage);
    const StageView view(environment, states, stage);
    StageState& state = states[stage];
    state = empty_state(view.system());
    start_uniform_items(view, state);
    start_varying_items(view, state);
    if (auto sides = find_sides(view, state); !sides) return sides;
    if (auto good = check_speed(view); !good) return good;
    state.started = true;
    return {};
}

}  // namespace cascade
