// What a run and its stages start with: the mask of the domain, starting values, sides, and what no
// step changes.
#include "lang/program/models.h"
#include "run/domain/field_values.h"
#include "run/simulation/simulation_implementation.h"
#include "run/stage/bind_side.h"
#include "run/stage/memory.h"

#include <algorithm>

namespace cascade {

namespace {

/// disc(…), ring(…) and box(…) whose numbers are written down, each once, as formulas of their own.
std::vector<Formula> written_areas(const Program& program) {
    std::vector<Formula> areas;
    for (const Formula* formula : formulas_of(program)) {
        for (const Node& node : formula->nodes) {
            if (node.kind != NodeKind::call) continue;
            if (node.function != Function::disc && node.function != Function::ring &&
                node.function != Function::box) {
                continue;
            }
            Formula area;
            Node call = node;
            for (NodeId& operand : call.reads()) {
                const Node& number = formula->nodes[operand];
                operand = area.nodes.next();
                area.nodes.push_back(number);
            }
            const bool is_known =
                std::all_of(area.nodes.begin(), area.nodes.end(),
                            [](const Node& number) { return number.kind == NodeKind::number; });
            const bool is_new = std::none_of(areas.begin(), areas.end(), [&](const Formula& other) {
                return other.nodes.back().span == call.span;
            });
            area.nodes.push_back(call);
            if (is_known && is_new) areas.push_back(std::move(area));
        }
    }
    return areas;
}

}  // namespace

Result<void> Simulation::Implementation::check_memory(std::uint64_t limit) {
    const TimeAccount::Scope spent(account, Spent::compiling);
    memory = memory_of(*program, *plans, model.get());
    return cascade::check_memory(grid, memory, limit);
}

Result<void> Simulation::Implementation::make_cells(const SimulationOptions& options) {
    const TimeAccount::Scope spent(account, Spent::cells);
    Team makers(threads);
    RunControl nobody;
    RunControl& control = options.control != nullptr ? *options.control : nobody;
    const ModelAccess access{script->folder, script->overrides.reads,
                             script->overrides.model_is_asked_for, options.cell_cache};
    auto made = make_model_cells(*program, access, makers, control);
    if (control.cancel) return failure("stopped while the cells of the model were made");
    if (!made) {
        script->diagnostics.error(program->domain.model->span, made.error().message,
                                  made.error().hint);
        return failure("the model cannot be used");
    }
    model = std::move(*made);
    if (control.warn) {
        for (const std::string& repair : model->repairs)
            control.warn("the model was repaired: " + repair);
    }
    grid = model->grid;
    return {};
}

Result<void> Simulation::Implementation::make_surface_values(const SimulationOptions& options) {
    if (!model) return {};
    const TimeAccount::Scope spent(account, Spent::cells);
    RunControl nobody;
    const std::atomic<bool>& cancel =
        (options.control != nullptr ? *options.control : nobody).cancel;
    surface_values = std::make_unique<SurfaceValues>(*program, *model, *team);
    surface_values->make(formulas_of(*program), cancel);
    if (cancel) return failure("stopped while distances on the model were found");
    if (states.empty() || options.control == nullptr || !options.control->warn) return {};
    // What is written for one model easily lies beside another one, and does nothing there.
    for (const Formula& area : written_areas(*program)) {
        if (largest_value(evaluate(plan_view(*program, area, 0), 0)[0], nullptr) > 0) continue;
        options.control->warn(fmt::format("no cell of the model lies in {}",
                                          script->sources.text(area.nodes.back().span)));
    }
    return {};
}

Result<void> Simulation::Implementation::find_mask(const RunControl* control) {
    if (!program->domain.mask || states.empty()) return {};
    const TimeAccount::Scope spent(account, Spent::starting);
    const std::vector<Field> values =
        run_plan(plan_mask(*program), interpreted(grid), context(0), grid, *team);
    if (control != nullptr && control->warn) warn_of_undefined_mask(*control);
    mask = make_domain_mask(values[0], grid);
    if (mask->cells == grid.cell_count() && control != nullptr && control->warn) {
        control->warn("the mask of the domain leaves no cell out: it is nowhere 0");
    }
    if (mask->cells > 0) return {};
    script->diagnostics.error(program->domain.mask->span, "no cell is inside the mask",
                              "cells where it is not 0 belong to the domain");
    return failure("the domain has no cells");
}

void Simulation::Implementation::start_uniform_items(std::uint32_t k) {
    const StepPlan plan = plan_uniform_start(*program, k);
    const Grid one{1, 1, Boundary::periodic};
    const std::vector<Field> values = run_plan(plan, interpreted(one), context(k), one, *team);
    for (std::size_t r = 0; r < values.size(); ++r) {
        states[k].numbers[plan.results[r]] = values[r].number_at(0, 0);
    }
}

void Simulation::Implementation::start_varying_items(std::uint32_t k) {
    const StepPlan& plan = plans->start(k);
    std::vector<Field> values = evaluate(plan, k);
    StageState& state = states[k];
    const System& system = program->system_of(k);
    for (std::size_t r = 0; r < values.size(); ++r) {
        const std::uint32_t item = plan.results[r];
        const int species = state.species_of_item[item];
        if (stage(k).uniform[item]) {
            state.numbers[item] = values[r].number_at(0, 0);
        } else if (species >= 0) {
            state.species[static_cast<std::size_t>(species)] = std::move(values[r]);
        } else {
            if (item == system.frozen_item()) state.frozen = to_mask(values[r]);
            state.fields[item] = std::move(values[r]);
        }
    }
}

bool Simulation::Implementation::is_sheared_at(Side side, SideKind kind) const {
    if (metric.empty() || kind != SideKind::flux) return false;
    const auto at = [&](MetricPlane plane, std::int64_t offset) {
        return metric[static_cast<std::size_t>(plane)].visit(
            [&](const auto& cells) { return double{cells.origin()[offset]}; });
    };
    const PlaneLayout layout(grid);
    const SideCells cells = SideCells::of_rows(layout, side, {0, layout.row_count()});
    for (std::int64_t k = 0; k < cells.count; ++k) {
        const std::int64_t offset = SideCells::offset(layout, side, k);
        const double across = std::abs(at(MetricPlane::inverse_12, offset));
        if (across > 1e-3 * std::abs(at(MetricPlane::inverse_22, offset))) return true;
    }
    return false;
}

Result<void> Simulation::Implementation::find_sides(std::uint32_t k) {
    StageState& state = states[k];
    std::vector<SideRules> found;
    std::vector<ChangingSide> changing_sides;
    for (const auto& settings : stage(k).sides) {
        const auto species = static_cast<std::uint32_t>(found.size());
        SideRules rules;
        rules.spacing = grid.spacing;
        for (std::size_t side = 0; side < side_count; ++side)
            rules.at[side].kind = settings[side].kind;
        for (std::size_t side = 0; side < side_count; ++side) {
            SideRule& rule = rules.at[side];
            if (!rule.has_value()) continue;
            const SidePlans value = plan_side(*program, settings[side], static_cast<Side>(side), k);
            if (is_sheared_at(static_cast<Side>(side), rule.kind)) {
                return failure(
                    fmt::format(
                        "stage '{}': {} has a flux at the side {}, where the surface is sheared",
                        stage(k).name, species_name(program->system_of(k), species),
                        side_names[side]),
                    "a flux needs rows and columns that meet at right angles; fixed(…) does not");
            }
            if (value.changes) {
                ChangingSide changing = bind_side(value, species, static_cast<Side>(side),
                                                  interpreted(grid), context(k), *team);
                if (!value.each.is_uniform) {
                    changing.values =
                        state.side_values.emplace_back(PlaneLayout(grid), precision()).address();
                    rule.values = changing.values;
                }
                changing_sides.push_back(std::move(changing));
                continue;
            }
            Field values = std::move(evaluate(value.each, k)[0]);
            rule.value = values.number_at(0, 0);
            if (is_same_everywhere(values)) continue;
            fill_halo(values, boundary_of(rules));
            rule.values = state.side_values.emplace_back(std::move(values)).address();
        }
        found.push_back(rules);
    }
    state.sides = std::move(found);
    state.changing_sides = std::move(changing_sides);
    return {};
}

void Simulation::Implementation::find_step_invariants(std::uint32_t k) {
    const TimeAccount::Scope spent(account, Spent::starting);
    const StepPlan& once = plans->step_invariants(k);
    StageState& state = states[k];
    state.step_invariants.clear();
    state.step_invariant_numbers.assign(once.result_count, 0);
    state.step_invariant_boundaries.resize(once.result_count);
    if (once.result_count == 0) return;
    state.step_invariants = evaluate(once, k);
    for (const PassTarget& target : once.passes.back().targets) {
        if (target.kind != PassTarget::Kind::result) continue;
        state.step_invariant_boundaries[target.index] = target.boundary;
        if (!target.is_uniform) continue;
        Field& plane = state.step_invariants[target.index];
        state.step_invariant_numbers[target.index] = plane.number_at(0, 0);
        plane = {};
    }
}

Result<void> Simulation::Implementation::check_speed(std::uint32_t k) const {
    const System& system = program->system_of(k);
    const std::uint32_t item = system.speed_item();
    double slowest = states[k].numbers[item];
    if (!stage(k).uniform[item]) slowest = smallest(states[k].fields[item], inside());
    if (slowest > 0 && std::isfinite(slowest)) return {};
    const std::string text = with_number(precision(), [&](auto zero) {
        return fmt::format("{}", static_cast<decltype(zero)>(slowest));
    });
    return failure(fmt::format("stage '{}': its speed is {}, but a time step must be above 0",
                               stage(k).name, text));
}

}  // namespace cascade
