// Fills in the settings of time of a stage, and checks whether they are compatible.
#include "lang/check/systems/check_solver.h"
#include "lang/check/systems/check_time.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

constexpr std::int64_t default_iterations = 1000;
/// If the `until` condition of a stage never holds, the stage stops after this number of steps.
constexpr std::int64_t most_iterations_until = 1'000'000;

template <typename T>
T pick(const std::optional<T>& own, const std::optional<T>& other, T otherwise) {
    return own.value_or(other.value_or(std::move(otherwise)));
}

/// Sets the duration of a stage with automatic steps to the time that the stage's iterations would
/// take at the given speed.
void count_duration_in_steps(Stage& stage) {
    if (stage.time.has_duration() || stage.time.open_end) return;
    stage.time.duration_in_steps = stage.iterations;
    stage.iterations = most_iterations;
}

template <typename Time>
bool has_condition(const Time& time) {
    return time.until || time.steady;
}

/// Sets when the stage is observed, by `interval` or `every`. If the stage sets either of these,
/// both settings of its system have no effect.
void fill_moments(Stage& stage, const Settings& own, const Settings& defaults) {
    const Settings& given = own.interval || own.time.every ? own : defaults;
    stage.time.every = given.time.every.value_or(0);
    stage.time.every_span = given.time.every_span;
    const bool by_time = given.time.every || stage.time.has_duration();
    const std::int64_t tenth = std::max<std::int64_t>(1, stage.iterations / 10);
    stage.interval = given.interval.value_or(by_time ? 0 : tenth);
}

void fill_end(Stage& stage, const Settings& own, const Settings& defaults) {
    // If the stage sets `iterations` or `duration`, both settings of its system have no effect.
    const bool own_end = own.iterations || own.time.duration;
    const auto& iterations = own_end ? own.iterations : defaults.iterations;
    stage.time.duration = own_end ? own.time.duration : defaults.time.duration;
    // A condition in the stage replaces the iterations of its system. If the stage itself sets
    // iterations, these remain, and the condition may end the stage earlier.
    stage.time.open_end =
        has_condition(stage.time) && !own_end && (has_condition(own.time) || !defaults.iterations);
    stage.iterations = stage.time.duration   ? most_iterations
                       : stage.time.open_end ? most_iterations_until
                                             : iterations.value_or(default_iterations);
    if (is_adaptive(stage.time.solver)) count_duration_in_steps(stage);
    fill_moments(stage, own, defaults);
}

/// The first node of a formula that reads an item; null if there is none.
const Node* find_reader(const Formula& formula, ItemId item) {
    const auto found = std::find_if(formula.nodes.begin(), formula.nodes.end(),
                                    [&](const Node& node) { return node.is(item); });
    return found == formula.nodes.end() ? nullptr : &*found;
}

/// The first node that reads `speed`; null if no node does. If a node reads `speed`, the value of
/// `speed` must be a number that is known in advance.
const Node* reader_of_speed(const Program& program, const Stage& stage) {
    const System& system = program.systems[stage.system];
    std::vector<const Formula*> formulas;
    for (const Formula& formula : stage.items) formulas.push_back(&formula);
    for (const Formula& rate : system.rates) formulas.push_back(&rate);
    for (const Definition& definition : system.definitions) formulas.push_back(&definition.formula);
    for (const Invariant& invariant : system.invariants) formulas.push_back(&invariant.bound);
    if (stage.time.until) formulas.push_back(&*stage.time.until);
    for (const Formula* formula : formulas) {
        if (const Node* node = find_reader(*formula, system.speed_item())) return node;
    }
    return nullptr;
}

/// The first node in a formula that varies by cell.
const Node* varying_part(const Program& program, std::uint32_t stage, const Formula& formula) {
    IdVector<NodeId, const Node*> cause(formula.nodes.size(), nullptr);
    for (const NodeId part : cause.ids()) {
        const Node& node = formula.nodes[part];
        if (differs_by_cell(node, false, program, stage)) cause[part] = &node;
        if (!node.is<Call>() || info(node.function).is_aggregate) continue;
        for (const NodeId operand : node.reads()) {
            if (cause[part] == nullptr) cause[part] = cause[operand];
        }
    }
    return cause.back();
}

void check_condition(Workspace& work, std::uint32_t stage) {
    const Node* varying = varying_part(work.program, stage, *work.program.stages[stage].time.until);
    if (varying == nullptr) return;
    work.diagnostics.error(varying->span,
                           "this condition differs from cell to cell, but a stage ends for all "
                           "cells at once",
                           "write one number for all cells, as in mean(u over domain) > 0.5");
}

}  // namespace

void fill_time(Stage& stage, const Settings& own, const Settings& defaults) {
    StageTime& time = stage.time;
    time.solver = pick(own.time.solver, defaults.time.solver, Solver::euler);
    time.solver_span = (own.time.solver ? own : defaults).time.solver_span;
    time.tolerance = own.time.tolerance ? own.time.tolerance : defaults.time.tolerance;
    const TimeSettings& largest = own.time.largest_step ? own.time : defaults.time;
    time.largest_step = largest.largest_step;
    time.largest_step_span = largest.largest_step_span;
    time.automatic_speed = pick(own.time.automatic_speed, defaults.time.automatic_speed, false);
    time.coarse = pick(own.time.coarse, defaults.time.coarse, time.coarse);
    time.coarse_span = (own.time.coarse ? own : defaults).time.coarse_span;
    time.check = own.time.check ? own.time.check : defaults.time.check;
    const TimeSettings& condition = has_condition(own.time) ? own.time : defaults.time;
    time.until = condition.until;
    time.steady = condition.steady;
    fill_end(stage, own, defaults);
}

void check_time(Workspace& work, std::uint32_t index) {
    const Stage& stage = work.program.stages[index];
    const System& system = work.program.systems[stage.system];
    const StageTime& time = stage.time;
    const Formula& speed = stage.items[system.speed_item()];
    const Span speed_span = speed.nodes.back().span;
    if (!takes_speed_by_cell(time.solver) && !stage.uniform[system.speed_item()]) {
        work.diagnostics.error(speed_span,
                               fmt::format("with {} all cells must have the same speed",
                                           name_of(time.solver)),
                               "write solver: euler or solver: symplectic for a speed that varies");
    }
    if (time.automatic_speed && !time.has_duration() && !time.open_end && !system.cells) {
        work.diagnostics.error(speed_span, "'iterations' cannot be used with 'speed: auto'",
                               "write duration: … instead");
    }
    if (time.largest_step && !time.chooses_steps()) {
        work.diagnostics.error(time.largest_step_span,
                               "'largest_step' has no effect, because 'speed' sets the length of "
                               "all steps",
                               "write speed: auto, solver: rk23 or solver: rk45");
    }
    if (time.every > 0 && !stage.uniform[system.speed_item()]) {
        work.diagnostics.error(time.every_span,
                               fmt::format("stage '{}' has no time, because its speed differs "
                                           "from cell to cell",
                                           stage.name),
                               "write 'interval', which counts steps");
    }
    if (time.chooses_steps()) {
        if (const Node* reader = reader_of_speed(work.program, stage)) {
            work.diagnostics.error(
                reader->span, fmt::format("the speed of stage '{}' cannot be read, because the "
                                          "stage chooses the length of its steps during the run",
                                          stage.name));
        }
    }
    if (time.until) check_condition(work, index);
}

void change_solver(Stage& stage, const TimeSettings& asked) {
    StageTime& time = stage.time;
    time.solver = *asked.solver;
    time.solver_span = asked.solver_span;
    if (is_adaptive(time.solver) || takes_long_steps(time.solver)) {
        count_duration_in_steps(stage);
        if (time.has_duration()) stage.interval = 0;
    }
    if (takes_long_steps(time.solver)) time.automatic_speed = true;
    if (!time.chooses_steps()) time.largest_step.reset();
}

}  // namespace cascade::checking
