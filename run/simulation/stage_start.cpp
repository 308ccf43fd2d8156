// Computes starting values in the order of the plans, and the values at sides after them.
#include "run/simulation/stage_start.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "core/side_cells.h"
#include "core/with_commas.h"
#include "lang/calculus/side_values.h"
#include "lang/program/nodes_of_rates.h"
#include "lang/program/stage_kinds.h"
#include "run/domain/field_values.h"
#include "run/domain/metric_planes.h"
#include "run/simulation/stage_view.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/plan_runner.h"
#include "solvers/changing_side.h"
#include "solvers/convolution.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

void start_varying_items(const StageView& view, StageState& state) {
    const StepPlan& plan = view.environment().plans.start(view.number());
    std::vector<Field> values = view.evaluate(plan);
    take_values(state, view.program(), view.number(), plan.results, values);
}

/// Whether the rows and columns of the surface meet at an oblique angle in any cell at this side.
/// Only sides with a slope are examined. For other sides, the result is false.
bool is_sheared_at(const Environment& here, Side side, SideKind kind) {
    if (here.metric.empty() || kind != SideKind::slope) return false;
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

/// Prepares the value of one species at a side, so that it can be computed for any moment. Computes
/// the parts that do not depend on the moment from the present state.
ChangingSide bind_side(const SidePlans& plans, std::uint32_t stage, SpeciesId species, Side side,
                       const Compile& compile, const BindingContext& context, Team& team) {
    const IdVector<StepInvariantId, Field> step_invariants(
        run_plan(plans.once, compile, context, context.grid, team));
    CHECK(plans.each.passes.size() == 1, "a side's value takes one pass");
    const BoundKernel& bound = plans.each.passes[0].bound;
    ChangingSide changing;
    changing.species = species;
    changing.side = side;
    changing.kernel = compile(*bound.kernel);
    changing.precision = context.precision;
    changing.varies = !plans.each.is_uniform;
    const StageState& own = context.states[stage];
    for (const PlaneSource& source : bound.fields) {
        const auto* const item = std::get_if<StageItem>(&source);
        const bool is_own = item != nullptr && item->stage == stage;
        changing.reads.push_back(is_own ? own.species_of_item[item->item] : std::nullopt);
        if (changing.reads.back()) {
            changing.strips.emplace_back();
            continue;
        }
        const auto* const id = std::get_if<StepInvariantId>(&source);
        const Field& plane = id != nullptr ? step_invariants[*id] : plane_of(source, context);
        std::vector<double>& strip = changing.strips.emplace_back(values_beside(plane, side));
        // Kernels read whole vectors, so padding is added to the strip.
        strip.resize(strip.size() + PlaneLayout::row_pad);
    }
    for (const UniformSource& source : bound.uniforms) {
        const auto slot = static_cast<std::uint32_t>(changing.uniforms.size());
        double& value = changing.uniforms.emplace_back(0);
        if (const auto* const each = std::get_if<StageItem>(&source)) {
            value = context.states[each->stage].numbers[each->item];
        } else if (const auto* const id = std::get_if<StepInvariantId>(&source)) {
            value = step_invariants[*id].number_at(0, 0);
        } else if (source == UniformSource(TimeValue::time)) {
            changing.time_slot = slot;
        } else {
            CHECK(source == UniformSource(TimeValue::step),
                  "a side's value knows numbers, t and step");
            changing.step_slot = slot;
        }
    }
    return changing;
}

/// Finds the rules of species and definitions at the sides. The values in these rules are formulas
/// that may read any starting value. If a value is the same along its whole side, it is stored as a
/// number. Until the rules are found, the boundary of the domain applies.
class SideFinder {
public:
    SideFinder(const StageView& view) : view_(view), here_(view.environment()) {}

    Result<void> add(std::string_view name, const SideSettings& settings) {
        const SpeciesId number(rules_.size());
        SideRules rules;
        rules.spacing = here_.grid.spacing;
        for (std::size_t side = 0; side < side_count; ++side)
            rules.at[side].kind = settings[side].kind;
        for (std::size_t side = 0; side < side_count; ++side) {
            SideRule& rule = rules.at[side];
            if (!rule.has_value()) continue;
            const SidePlans value =
                plan_side(*here_.program, settings[side], static_cast<Side>(side), view_.number());
            if (is_sheared_at(here_, static_cast<Side>(side), rule.kind)) {
                return failure(
                    fmt::format(
                        "stage '{}': {} has a slope at the side {}, where the surface is sheared",
                        view_.stage().name, name, side_names[side]),
                    "use fixed(…): slope(…) and flux(…) need rows and columns that meet at right "
                    "angles");
            }
            if (value.changes) {
                changing_.push_back(bind_side(value, view_.number(), number,
                                              static_cast<Side>(side), here_.kernels.interpreted(),
                                              view_.context(), here_.team));
                continue;
            }
            const Field values = std::move(view_.evaluate(value.each)[0]);
            rule.value = values.number_at(0, 0);
            if (is_same_everywhere(values)) continue;
            rule.values = std::make_shared<const SideValues>(
                SideValues{0, values_beside(values, static_cast<Side>(side))});
        }
        rules_.push_back(rules);
        return {};
    }

    void give_to(StageState& state) && {
        state.fields().sides = std::move(rules_);
        state.fields().changing_sides = std::move(changing_);
        state.go_to(state.steps, state.t);
    }

private:
    const StageView& view_;
    const Environment& here_;
    std::vector<SideRules> rules_;
    std::vector<ChangingSide> changing_;
};

Result<void> find_sides(const StageView& view, StageState& state) {
    SideFinder finder(view);
    const auto of_species = side_settings(view.program(), view.number());
    for (const SpeciesId species : of_species.ids()) {
        const std::string name = species_name(view.system(), species.index());
        if (auto good = finder.add(name, of_species[species]); !good) return good;
    }
    for (const DefinitionSides& each : view.stage().definition_sides) {
        const std::string& name = view.system().definitions[each.definition].name;
        if (auto good = finder.add(name, each.sides); !good) return good;
    }
    std::move(finder).give_to(state);
    return {};
}

Result<void> check_speed(const StageView& view) {
    const Environment& here = view.environment();
    const ItemId item = view.system().speed_item();
    double slowest = view.state().numbers[item];
    if (!view.stage().uniform[item]) slowest = smallest(view.state().field(item), here.inside());
    if (slowest > 0 && std::isfinite(slowest)) return {};
    const std::string text = with_number(here.precision(), [&](auto zero) {
        return fmt::format("{}", static_cast<decltype(zero)>(slowest));
    });
    return failure(fmt::format("stage '{}': its speed is {}, but a time step must be above 0",
                               view.stage().name, text));
}

/// Refuses a convolution over too many cells before any convolution is computed.
Result<void> check_reaches(const StageView& view) {
    const Environment& here = view.environment();
    Result<void> good;
    const auto check = [&](const ConvolutionKernel& kernel) {
        std::optional<double> reach;
        if (!kernel.reach.nodes.empty()) {
            const Grid one{1, 1, Boundary::periodic};
            reach = run_plan(plan_view(view.program(), kernel.reach, view.number()),
                             here.kernels.interpreted_on(one), view.context(), one, here.team)[0]
                        .number_at(0, 0);
        }
        if (!good || lags_in_box(here.grid, reach) <= most_lags) return;
        good = failure(fmt::format("stage '{}': convolve {} adds up more than {} cells",
                                   view.stage().name,
                                   reach ? fmt::format("with a reach of {:.4g}", *reach)
                                         : std::string("without a reach"),
                                   with_commas(most_lags)),
                       reach ? "make the reach shorter"
                             : "use convolve(k, e, r), which reads only the cells within the "
                               "distance r");
    };
    for_each_kernel_of_stage(view.program(), view.number(), check);
    return good;
}

}  // namespace

void start_uniform_items(const StageView& view, StageState& state) {
    // Uniform items can be computed on a grid of one cell.
    const StepPlan plan = plan_uniform_start(view.program(), view.number());
    const Grid one{1, 1, Boundary::periodic};
    const Environment& here = view.environment();
    const std::vector<Field> values =
        run_plan(plan, here.kernels.interpreted_on(one), view.context(), one, here.team);
    for (std::size_t r = 0; r < values.size(); ++r) {
        state.numbers[plan.results[r]] = values[r].number_at(0, 0);
    }
}

Result<void> start_stage(const Environment& environment, std::span<StageState> states,
                         std::uint32_t stage, const std::atomic<bool>& cancel) {
    if (is_of_cells(*environment.program, stage))
        return start_tissue(environment, states, stage, cancel);
    const TimeAccount::Scope spent(environment.account, Spent::starting, stage);
    const StageView view(environment, states, stage);
    StageState& state = states[stage];
    state = empty_state(view.system());
    start_uniform_items(view, state);
    if (auto good = check_reaches(view); !good) return good;
    start_varying_items(view, state);
    if (auto sides = find_sides(view, state); !sides) return sides;
    if (auto good = check_speed(view); !good) return good;
    state.started = true;
    return {};
}

}  // namespace cascade
