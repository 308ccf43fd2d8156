// The time of one stage in a run: the passes of its solver, the length of steps, and the end.
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

/// The largest number of parts into which a step on a model, or with a size, is split.
inline constexpr std::uint32_t most_substeps = 10000;

/// Computes some numbers from the present values.
using NumberSource = std::function<std::vector<double>()>;

/// Queries of a stage's time to the simulation that it belongs to. All read the present values.
struct StageTools {
    std::function<StepProblem(const Scheme&)> bind;
    /// Makes a function that computes formulas that are the same in all cells, to be called
    /// repeatedly.
    std::function<NumberSource(std::span<const Formula* const>)> numbers;
    /// The values of a formula of constants and `t` alone.
    std::function<ValueAt(const Formula&)> at_time;
    /// For a formula that also reads places: what Forcing::add_motion() takes.
    std::function<std::vector<double>(const Formula&, double duration)> motion;
    /// Does the condition of the stage's `until` hold?
    std::function<bool()> condition_holds;
    /// Bounds the eigenvalues by a power iteration, if there is no bound by rule.
    std::function<double()> estimate;
    const Mask* inside = nullptr;       ///< The cells that count, with a mask or on a model.
    const ModelFacts* model = nullptr;  ///< Null on grids.
};

class StageTimer {
public:
    /// `state` is the stage's; a stage that has not taken a step begins its time here.
    StageTimer(const Program& program, std::uint32_t stage, StageState& state, StageTools tools);

    /// The number of parts of each step that make it stable on the cells of a model and with a
    /// size.
    std::uint32_t substeps() const {
        return stage_.time.solver == Solver::euler ? state_.time.stages : 0;
    }
    /// The number of stages of Runge-Kutta-Legendre that replace the parts of a step; 0: none do.
    static std::uint32_t stages_for_parts(std::uint32_t parts);
    /// A step of Euler that is split into parts, at least 2, or what stands for them.
    static Scheme split_scheme(std::uint32_t species, std::uint32_t parts);
    /// The passes of the first step.
    const StepProblem& problem();
    /// A complete schedule except for its threads. `interval` as in Schedule.
    Schedule schedule(std::int64_t last_step, std::int64_t interval);

private:
    bool chooses() const;
    bool chooses_by_error() const;
    std::uint32_t substeps(const Program& program, std::uint32_t stage) const;
    RateBounds bounds() const;
    Forcing forcing(const Program& program, std::uint32_t stage) const;
    void set_first_step();
    double expected_duration() const;  ///< Finite, even if only `until` ends the stage.
    double longest_step(bool is_bounded) const;
    void look_at_bounds(std::int64_t step, TimeState& time);
    StepChoice choose_stages_at(std::int64_t step, TimeState& time);
    StepChoice choose_by_error(std::int64_t step, TimeState& time, bool rejected);
    std::int64_t stretch_after(const RateBounds& before, const TimeState& time, bool rejected,
                               double length, double longest) const;
    Scheme scheme_of(std::uint32_t stages) const;
    const StepProblem& problem_of(std::uint32_t stages, bool is_judged);
    bool has_ended(std::int64_t step, double t);

    const Stage& stage_;
    StageState& state_;
    StageTools tools_;
    std::uint32_t species_;
    bool begins_anew_ = false;  ///< After other steps, such as of a changed script.
    bool uniform_speed_;
    double speed_;                 ///< The item's value; 1 if it varies by cell.
    double duration_;              ///< Infinite if there is none.
    Forcing forcing_;              ///< For steps of chosen length.
    NumberSource bounds_by_rule_;  ///< Computes RateBounds; null if there is no rule.
    bool jumps_ = false;           ///< Do rates jump at thresholds?
    /// By the number of stages, and by whether the error of the step is estimated.
    std::map<std::pair<std::uint32_t, bool>, StepProblem> problems_;
};

/// Is the length of each step the item `speed`, which may vary by cell?
bool steps_by_item(const Stage& stage);

/// Is the error of every step estimated?
bool judges_all_steps(const Stage& stage);

/// The duration of a stage that has started; infinite if it has none.
double duration_of(const Stage& stage, const System& system, const StageState& state);

}  // namespace cascade
