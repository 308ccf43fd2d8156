#include "run/stage_time.h"

#include "lang/derivative.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// Where nothing says how long a stage takes, steps of chosen length are no longer than a part of
/// this.
constexpr double usual_duration = 10000;
/// What is not known to be reaction or diffusion is taken for diffusion in the main.
constexpr double share_of_reaction = 0.02;

}  // namespace

bool steps_by_item(const Stage& stage) {
    return takes_speed_by_cell(stage.time.solver) && !stage.time.automatic_speed &&
           !stage.time.has_duration();
}

double duration_of(const Stage& stage, const System& system, const StageState& state) {
    if (stage.time.duration) return *stage.time.duration;
    if (!stage.time.duration_in_steps) return std::numeric_limits<double>::infinity();
    return static_cast<double>(*stage.time.duration_in_steps) *
           state.numbers[system.speed_item()];
}

StageTimer::StageTimer(const Program& program, std::uint32_t stage, StageState& state,
                       StageTools tools)
    : stage_(program.stages[stage]),
      state_(state),
      tools_(std::move(tools)),
      species_(static_cast<std::uint32_t>(state.species.size())) {
    const System& system = program.system_of(stage);
    uniform_speed_ = stage_.uniform[system.speed_item()];
    speed_ = uniform_speed_ ? state.numbers[system.speed_item()] : 1;
    duration_ = duration_of(stage_, system, state);
    if (chooses()) {
        if (const auto bound = jacobian_bound(program, stage)) {
            const Formula* const formulas[] = {&bound->whole, &bound->reaction};
            bounds_by_rule_ = tools_.numbers(formulas);
            jumps_ = bound->jumps;
        }
    }
    state_.time.clock.precision = program.domain.precision;
    // A stage whose time is known goes on as it was.
    if (state_.steps > 0 && state_.time.control.step > 0) return;
    state_.time = {};
    state_.time.clock.precision = program.domain.precision;
    state_.time.clock.step = uniform_speed_ ? speed_ : 0;
    state_.time.control.step = speed_;
    state_.time.stages = is_stabilised(stage_.time.solver) ? 3 : 0;
    state_.t = state_.time.clock.at(state_.steps);
    if (program.domain.model) state_.time.stages = substeps(program, stage);
    if (state_.steps == 0 && stage_.time.steady) state_.watch.begin(state_.species);
}

/// Are steps or stages chosen by the state of the species?
bool StageTimer::chooses() const {
    return is_stabilised(stage_.time.solver) ||
           (stage_.time.automatic_speed && !is_adaptive(stage_.time.solver));
}

/// Cells of a model have links of different weights, and the largest decide which steps are stable: a
/// script that is stable on the plane has to be so there. Explicit Euler is stable up to 2 over the largest
/// eigenvalue.
std::uint32_t StageTimer::substeps(const Program& program, std::uint32_t stage) const {
    constexpr double safety = 0.95;
    const bool is_split = stage_.time.solver == Solver::euler && !stage_.time.automatic_speed &&
                          uniform_speed_;
    if (!is_split) return state_.time.stages;
    double decay = 0;
    if (const auto bound = jacobian_bound(program, stage)) {
        const Formula* const formulas[] = {&bound->whole, &bound->reaction};
        const std::vector<double> bounds = tools_.numbers(formulas)();
        decay = bounds[0] - bounds[1];
    }
    if (!std::isfinite(decay)) return state_.time.stages;
    const double parts = std::ceil(speed_ * decay / (2 * safety));
    return parts > 1 && parts <= most_substeps ? static_cast<std::uint32_t>(parts) : 0;
}

const StepProblem& StageTimer::problem() { return problem_of(state_.time.stages); }

const StepProblem& StageTimer::problem_of(std::uint32_t stages) {
    const auto known = problems_.find(stages);
    if (known != problems_.end()) return known->second;
    const bool is_split = stage_.time.solver == Solver::euler && stages > 1;
    const Scheme scheme = is_split ? make_substeps(stages)
                                   : make_scheme(stage_.time.solver, species_,
                                                 steps_by_item(stage_), stages);
    return problems_.emplace(stages, tools_.bind(scheme)).first->second;
}

RateBounds StageTimer::bounds() const {
    if (bounds_by_rule_) {
        const std::vector<double> bounds = bounds_by_rule_();
        if (std::isfinite(bounds[0]) && std::isfinite(bounds[1])) return {bounds[0], bounds[1], jumps_};
    }
    const double whole = tools_.estimate();
    // What is explicit may be as fast as all of it: advection is no diffusion.
    if (is_semi_implicit(stage_.time.solver)) return {whole, whole, jumps_};
    return {whole, share_of_reaction * whole, jumps_};
}

StepChoice StageTimer::choose(std::int64_t step) {
    state_.steps = step;
    const Solver solver = stage_.time.solver;
    StepChoice choice;
    if (stage_.time.automatic_speed) {
        choice = choose_step(solver, bounds(), std::isfinite(duration_) ? duration_ : usual_duration);
    } else {
        choice.step = speed_;
        choice.stages = choose_stages(solver, bounds(), speed_);
    }
    choice.problem = &problem_of(choice.stages);
    return choice;
}

bool StageTimer::has_ended(double t) {
    state_.t = t;
    if (stage_.time.until) return tools_.is_true(*stage_.time.until);
    // Steps of different length in different cells are counted, not timed.
    const double age = uniform_speed_ ? t : static_cast<double>(state_.steps);
    return state_.watch.settled(state_.species, age, *stage_.time.steady, tools_.inside);
}

Schedule StageTimer::schedule(std::int64_t last_step, std::int64_t interval) {
    Schedule schedule;
    schedule.first_step = state_.steps;
    schedule.last_step = last_step;
    schedule.time = state_.time;
    schedule.end_time = duration_;
    schedule.interval = interval;
    if (stage_.time.until || stage_.time.steady) {
        schedule.check = stage_.time.steps_between_looks();
        schedule.ends = [this](std::int64_t step, double t, std::span<const Field>) {
            state_.steps = step;
            state_.condition_met = has_ended(t);
            return state_.condition_met;
        };
    }
    if (is_adaptive(stage_.time.solver)) {
        schedule.tolerance = stage_.time.tolerance;
        schedule.error_order = order_of(stage_.time.solver);
    }
    if (chooses()) {
        schedule.choose_every = choose_every(stage_.time.solver, bounds_by_rule_ != nullptr);
        schedule.choose = [this](std::int64_t step, std::span<const Field>) { return choose(step); };
    }
    return schedule;
}

}  // namespace cascade
