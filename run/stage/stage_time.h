// The time of one stage in a run: the passes of its solver, how long steps are, when it ends.
#pragma once

#include "lang/program/models.h"
#include "run/stage/automatic_speed.h"
#include "run/stage/forcing.h"
#include "run/stage/stage_state.h"
#include "solvers/advance.h"
#include "solvers/scheme.h"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// Into how many a step on a model is split at most.
inline constexpr std::uint32_t most_substeps = 10000;

/// Computes some numbers from the present values.
using NumberSource = std::function<std::vector<double>()>;

/// What the time of a stage asks of the simulation it belongs to. All look at the present values.
struct StageTools {
    std::function<StepProblem(const Scheme&)> bind;
    /// Makes what computes formulas that are the same in all cells, again and again.
    std::function<NumberSource(std::span<const Formula* const>)> numbers;
    /// The values of a formula that reads constants and `t` alone, at n / Forcing::intervals of a
    /// duration.
    std::function<std::vector<double>(const Formula&, double duration)> over_time;
    std::function<bool(const Formula&)> is_true;
    /// A bound of the eigenvalues by a power iteration, where there is none by rule.
    std::function<double()> estimate;
    const Mask* inside = nullptr;       ///< Of a mask or a model: the cells that count.
    const ModelFacts* model = nullptr;  ///< Of the model that is the domain; null on grids.
};

class StageTimer {
public:
    /// `state` is that of the stage; a stage that has not taken a step begins its time here.
    StageTimer(const Program& program, std::uint32_t stage, StageState& state, StageTools tools);

    /// Into so many parts each step is split, so that it is stable on the cells of a model.
    std::uint32_t substeps() const {
        return stage_.time.solver == Solver::euler ? state_.time.stages : 0;
    }
    /// The passes of the first step.
    const StepProblem& problem();
    /// All of a schedule but its threads. `interval` as in Schedule.
    Schedule schedule(std::int64_t last_step, std::int64_t interval);

private:
    bool chooses() const;
    bool chooses_by_error() const;
    std::uint32_t substeps(const Program& program, std::uint32_t stage) const;
    RateBounds bounds() const;
    Forcing forcing(const Program& program, std::uint32_t stage) const;
    void set_first_step();
    double expected_duration() const;  ///< Finite, also where only `until` ends the stage.
    double longest_step(bool is_bounded) const;
    void look_at_bounds(std::int64_t step, TimeState& time);
    StepChoice choose_stages_at(std::int64_t step, TimeState& time);
    StepChoice choose_by_error(std::int64_t step, TimeState& time, bool rejected);
    std::int64_t stretch_after(const RateBounds& before, const TimeState& time, bool rejected,
                               double length, double longest) const;
    const StepProblem& problem_of(std::uint32_t stages, bool is_judged);
    bool has_ended(std::int64_t step, double t);

    const Stage& stage_;
    StageState& state_;
    StageTools tools_;
    std::uint32_t species_;
    bool uniform_speed_;
    double speed_;                 ///< The item's value; 1 where it varies by cell.
    double duration_;              ///< Infinite where there is none.
    Forcing forcing_;              ///< Of steps of chosen length.
    NumberSource bounds_by_rule_;  ///< Of RateBounds; none where there is no rule.
    bool jumps_ = false;           ///< Do rates jump at thresholds?
    /// By the number of stages, and whether the error of the step is estimated.
    std::map<std::pair<std::uint32_t, bool>, StepProblem> problems_;
};

/// Is each step of a stage as long as its item `speed` says, which may vary by cell?
bool steps_by_item(const Stage& stage);

/// Is the error of every step estimated?
bool judges_all_steps(const Stage& stage);

/// The duration of a stage that has started; infinite where it has none.
double duration_of(const Stage& stage, const System& system, const StageState& state);

}  // namespace cascade
