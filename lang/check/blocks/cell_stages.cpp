// Checks stages of crawling cells: founders, cells of earlier stages, and the end of the stage.
#include "lang/check/blocks/cell_stages.h"

#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/cell_frame.h"
#include "lang/check/systems/check_time.h"
#include "lang/program/cell_items.h"
#include "lang/program/stage_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::checking {

namespace {

/// The tolerance of positions: a hundredth of a radius. With a tenth of this tolerance, a run takes
/// twice as many steps, but the number of cells and their area after divisions are the same.
constexpr double usual_tolerance = 0.01;

constexpr double most_founders = 100'000'000;
constexpr double largest_coordinate = 1e15;
/// If the condition that ends a stage never holds, the stage stops after this number of steps.
constexpr std::int64_t most_steps_until = 1'000'000;

/// The call of keys(…) of which the expression consists; null if it is not such a call.
const ast::Call* call_of_keys(const ast::Script& script, ast::Expression expression) {
    const auto* call = std::get_if<ast::Call>(&script.expressions[expression.root].node);
    return call != nullptr && call->function.text == "keys" ? call : nullptr;
}

/// Checks keys(x, y, z, …).
void check_places(Workspace& work, const ast::Script& script, ast::Expression expression,
                  const ast::Call& call, Founders& founders) {
    if (call.argument_count == 0 || call.argument_count % 3 != 0) {
        work.diagnostics.error(founders.span,
                               "keys(…) must give three coordinates for each "
                               "founder",
                               "for example, write founders: keys(0.5, 0.5, 0)");
        return;
    }
    ast::ExprId first = expression.first;
    for (std::uint32_t k = 0; k < call.argument_count; ++k) {
        const ast::ExprId last = script.arguments[call.first_argument + k];
        const auto value = check_constant(work, script, {first, last}, "a coordinate",
                                          Dimension::of(BaseQuantity::length));
        first = last + 1;
        if (!value) return;
        if (!(std::abs(*value) <= largest_coordinate)) {
            work.diagnostics.error(script.expressions[last].span, "this number is too large",
                                   "coordinates are 0..1 along the longest side");
            return;
        }
        founders.places.push_back(*value);
    }
}

void check_count_of_founders(Workspace& work, const ast::Script& script, ast::Expression value,
                             Founders& founders) {
    const auto count = check_constant(work, script, value, "the number of founders");
    if (!count) return;
    if (*count >= 1 && *count <= most_founders && *count == std::floor(*count)) {
        founders.count = static_cast<std::int64_t>(*count);
        return;
    }
    work.diagnostics.error(span_of(script, value),
                           fmt::format("the number of founders must be a whole number from 1 to "
                                       "{:.0f}",
                                       most_founders));
}

/// Checks `founders: n`, `founders: n, chance` or `founders: keys(x, y, z, …)`.
void check_founders(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                    const Scope& scope) {
    const ast::Expression first = statement.values.front();
    Founders& founders = work.draft->stages[*scope.stage].founders.emplace();
    founders.span = statement.span;
    const std::size_t most = call_of_keys(script, first) != nullptr ? 1 : 2;
    if (statement.values.size() > most) {
        work.diagnostics.error(span_of(script, statement.values[most]),
                               "'founders' takes either a number with an optional chance, or "
                               "positions",
                               "write founders: 6 or founders: keys(0.5, 0.5, 0), for example");
        return;
    }
    if (const ast::Call* call = call_of_keys(script, first)) {
        return check_places(work, script, first, *call, founders);
    }
    check_count_of_founders(work, script, first, founders);
    if (statement.values.size() == 1) return;
    auto chance = check_number(work, script, statement.values[1], scope);
    if (!chance) return;
    const auto own = std::ranges::find_if(chance->formula.nodes,
                                          [](const Node& node) { return node.is<ItemId>(); });
    if (own != chance->formula.nodes.end()) {
        work.diagnostics.error(own->span, "the chance of a founder cannot read values of cells",
                               "the chance may depend on the position and on earlier stages");
        return;
    }
    mark_reads(work, chance->formula, scope.system);
    founders.chance = std::move(chance->formula);
}

/// Checks `body: e`. check_cell_stage() checks whether the domain can have a body.
void check_body(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                const Scope& scope) {
    auto body = check_number(work, script, statement.values.front(), scope);
    if (!body) return;
    const auto is_of_cells = [&](const Node& node) {
        const auto* earlier = node.as<StageItem>();
        return node.is<ItemId>() || node.is<CellValue>() ||
               (earlier != nullptr && work.cell_stages[earlier->stage]);
    };
    const auto own = std::ranges::find_if(body->formula.nodes, is_of_cells);
    if (own != body->formula.nodes.end()) {
        work.diagnostics.error(own->span,
                               "the body is made before the cells, so it cannot read values of "
                               "cells",
                               "the body may read the position and earlier stages of fields");
        return;
    }
    bool reads_fields = false;
    for (Node& node : body->formula.nodes) {
        // Reads the field itself, because the body is computed in the cells of the grid and not at
        // the positions of crawling cells.
        if (const auto* sensed = node.as<SensedItem>()) node.kind = sensed->item;
        reads_fields |= node.is<StageItem>();
    }
    if (!reads_fields) {
        work.diagnostics.error(span_of(script, statement.values.front()),
                               "'body' must read a stage of fields",
                               "write body: coral.v - 0.3, for example; for a formula without "
                               "fields write domain { surface: implicit(…) }");
        return;
    }
    mark_reads(work, body->formula, scope.system);
    work.draft->stages[*scope.stage].body = std::move(body->formula);
}

/// The first node in a system's formulas that reads a stage which does not run before `stage`; null
/// if there is none.
const Node* sensed_too_early(const System& system, std::uint32_t stage) {
    const Node* found = nullptr;
    const auto look = [&](const Formula& formula) {
        for (const Node& node : formula.nodes) {
            const auto* sensed = node.as<SensedItem>();
            if (found == nullptr && sensed != nullptr && sensed->item.stage >= stage) found = &node;
        }
    };
    for (const Quantity& quantity : system.quantities) look(quantity.start);
    for (const Definition& definition : system.definitions) look(definition.formula);
    for (const Formula& rate : system.rates) look(rate);
    for (const Formula* rule : rules_of(system)) look(*rule);
    for (const auto* formula : {&system.settings.frozen, &system.settings.show}) {
        if (*formula) look(**formula);
    }
    return found;
}

/// Whether the cells of a stage are on a surface. The surface is a model, or a body that is given
/// by this stage or by an earlier stage of the same cells.
bool has_surface(const Program& program, std::uint32_t stage) {
    if (program.domain.model || program.domain.surface) return true;
    std::optional<std::uint32_t> of = stage;
    while (of && program.stages[*of].body.nodes.empty() && !program.stages[*of].founders) {
        of = stage_of_cells_before(program, *of);
    }
    return !of || !program.stages[*of].body.nodes.empty();
}

/// The name of a value that the rates or rules of cells read and that exists only on a surface;
/// empty if they read no such value. On a plane, cells also have a distance and a normal.
std::string_view read_of_surface(const System& system, bool is_plane) {
    std::string_view found;
    const auto look = [&](const Formula& formula) {
        for (const Node& node : formula.nodes) {
            const auto* value = node.as<CellValue>();
            const auto* builtin = node.as<Builtin>();
            if (value != nullptr &&
                (*value == CellValue::feature ||
                 (!is_plane && (*value == CellValue::off || *value == CellValue::normal)))) {
                found = cell_value_names[static_cast<std::size_t>(*value)];
            } else if (builtin != nullptr && *builtin >= Builtin::curvature) {
                found = builtin_names[static_cast<std::size_t>(*builtin)];
            }
        }
    };
    for (const Definition& definition : system.definitions) look(definition.formula);
    for (const Formula& rate : system.rates) look(rate);
    for (const Formula* rule : rules_of(system)) look(*rule);
    return found;
}

void check_solver(Workspace& work, const StageTime& time) {
    if (!changes_in_turn(time.solver) && !is_partly_implicit(time.solver)) return;
    work.diagnostics.error(time.solver_span,
                           fmt::format("the solver {} works only for fields, not for cells that "
                                       "crawl",
                                       name_of(time.solver)),
                           "use rkl2, rkl1, euler, rk2, rk4, rk23 or rk45");
}

}  // namespace

void check_cell_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope) {
    if (statement.name.text == "founders") return check_founders(work, script, statement, scope);
    if (!has_one_value(work, script, statement)) return;
    if (statement.name.text == "body") return check_body(work, script, statement, scope);
    auto condition = check_number(work, script, statement.values.front(), scope);
    if (!condition) return;
    mark_reads(work, condition->formula, scope.system);
    work.draft->stages[*scope.stage].remove = std::move(condition->formula);
}

void fill_cell_time(Workspace& work, std::uint32_t index, const Settings& own,
                    const Settings& defaults) {
    Stage& stage = work.draft->stages[index];
    fill_time(stage, own, defaults);
    StageTime& time = stage.time;
    const bool has_solver = own.time.solver || defaults.time.solver;
    if (!has_solver) time.solver = Solver::rkl2;
    check_solver(work, time);
    time.automatic_speed = !is_adaptive(time.solver);
    if (!time.tolerance) time.tolerance = usual_tolerance;
    // `iterations` limits the number of steps even if something else ends the stage.
    time.duration_in_steps.reset();
    time.duration = own.time.duration ? own.time.duration : defaults.time.duration;
    const auto& most = own.iterations ? own.iterations : defaults.iterations;
    const bool has_condition = time.until || time.steady;
    time.open_end = !time.duration && has_condition;
    if (!time.duration && !has_condition && !most) {
        work.diagnostics.error(stage.span,
                               fmt::format("stage '{}' does not say when it ends", stage.name),
                               "write duration: …, until: steady(0.001) or iterations: …");
    }
    stage.iterations = most.value_or(time.duration ? most_iterations : most_steps_until);
    if (own.interval || defaults.interval || time.every > 0) return;
    stage.interval = time.duration ? 0 : std::max<std::int64_t>(1, stage.iterations / 10);
}

void change_cell_solver(Workspace& work, std::uint32_t index, const TimeSettings& asked) {
    StageTime& time = work.draft->stages[index].time;
    time.solver = *asked.solver;
    time.solver_span = asked.solver_span;
    check_solver(work, time);
    time.automatic_speed = !is_adaptive(time.solver);
}

void take_cell_size(Workspace& work, std::uint32_t index) {
    Stage& stage = work.draft->stages[index];
    if (!(stage.cell_size > 0)) return;
    Formula& radius = stage.items[work.program.systems[stage.system].cells->radius];
    if (!radius.nodes.empty()) {
        work.diagnostics.error(radius.nodes.back().span,
                               "cells start either with a radius 'r' or with a 'size', not with "
                               "both",
                               "leave one of them out");
        return;
    }
    const Grid& grid = work.program.domain.grid;
    const double longest = grid.spacing * static_cast<double>(grid.longest_side());
    radius = {{Node{stage.cell_size / 2 / longest, stage.span}}};
}

void take_cells(Workspace& work, std::uint32_t index, std::array<Formula, 2> axes) {
    Stage& stage = work.draft->stages[index];
    const System& system = work.program.systems[stage.system];
    const CellRules& rules = *system.cells;
    if (!axes[0].nodes.empty() || !axes[1].nodes.empty()) {
        const std::array<const Formula*, 2> usual{&rules.ey, &rules.ez};
        for (std::size_t k = 0; k < 2; ++k) {
            if (axes[k].nodes.empty()) axes[k] = *usual[k];
            mark_reads(work, axes[k], stage.system);
        }
        auto frame = starting_frame(axes[0], axes[1]);
        for (std::uint32_t k = 0; k < 4; ++k) {
            stage.items[ItemId(rules.frame.index() + k)] = std::move(frame[k]);
        }
    }
    if (stage.founders) return;
    const auto before = stage_of_cells_before(work.program, index);
    if (!before) {
        work.diagnostics.error(stage.span,
                               fmt::format("stage '{}' has no cells to start with", stage.name),
                               "write founders: 6, for cells at random positions");
        return;
    }
    const CellRules& source = *work.program.system_of(*before).cells;
    const auto take = [&](ItemId to, ItemId from) {
        if (!stage.items[to].nodes.empty()) return;
        stage.items[to] = {{Node{StageItem{*before, from}, stage.span}}};
    };
    for (std::uint32_t k = 0; k < 3; ++k) {
        take(ItemId(rules.place.index() + k), ItemId(source.place.index() + k));
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
        take(ItemId(rules.frame.index() + k), ItemId(source.frame.index() + k));
    }
    take(rules.radius, source.radius);
    take(rules.age, source.age);
}

void check_cell_stage(Workspace& work, std::uint32_t index) {
    const Stage& stage = work.program.stages[index];
    const System& system = work.program.systems[stage.system];
    if (const Node* sensed = sensed_too_early(system, index)) {
        const std::uint32_t other = std::get<SensedItem>(sensed->kind).item.stage;
        work.diagnostics.error(
            sensed->span, fmt::format("the cells of stage '{}' sense stage '{}', which runs later",
                                      stage.name, work.program.stages[other].name));
    }
    const DomainSettings& domain = work.program.domain;
    if (!stage.body.nodes.empty() && (domain.model || domain.grid.depth == 1)) {
        work.diagnostics.error(stage.body.nodes.front().span, "'body' needs a grid with slices",
                               domain.model ? "leave 'body' out: on a model the cells crawl on "
                                              "the model's surface"
                                            : "for example, write domain { grid: 64, 64, 64 }");
    }
    if (!has_surface(work.program, index)) {
        const std::string_view name = read_of_surface(system, domain.grid.depth == 1);
        if (!name.empty()) {
            work.diagnostics.warning(
                stage.span,
                fmt::format("the cells of stage '{}' read '{}', but there is no surface in this "
                            "domain",
                            stage.name, name),
                domain.grid.depth == 1 ? "domain { surface: sphere } makes a surface"
                                       : "domain { surface: sphere } or body: … makes a surface");
        }
    }
    for (const Formula& distance : system.cells->near) {
        const auto varies = std::ranges::find_if(distance.nodes, [&](const Node& node) {
            const auto* item = node.as<ItemId>();
            return item != nullptr && !stage.uniform[*item];
        });
        if (varies == distance.nodes.end()) continue;
        work.diagnostics.error(varies->span,
                               "the distance of 'near' must be one number for all "
                               "cells",
                               fmt::format("this distance differs between the cells of stage '{}'",
                                           stage.name));
    }
}

}  // namespace cascade::checking
