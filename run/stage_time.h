// The time of one stage in a run: the passes of its solver, how long steps are, when it ends.
#pragma once

#include "lang/program.h"
#include "run/automatic_speed.h"
#include "run/simulation.h"
#include "solvers/scheme.h"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
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
    std::function<bool(const Formula&)> is_true;
    /// A bound of the eigenvalues by a power iteration, where there is none by rule.
    std::function<double()> estimate;
    const Mask* inside = nullptr;  ///< Of a mask or a model: the cells that count.
};

class StageTimer {
public:
    /// `state` is that of the stage; a stage that has not taken a step begins its time here.
    StageTimer(const Program& program, std::uint32_t stage, StageState& state, StageTools tools);

    /// Into so many parts each step is split, so that it is stable on the cells of a model.
    std::uint32_t substeps() const { return stage_.time.solver == Solver::euler ? state_.time.stages : 0; }
    /// The passes of the first step.
    const StepProblem& problem();
    /// All of a schedule but its threads. `interval` as in Schedule.
    Schedule schedule(std::int64_t last_step, std::int64_t interval);

private:
    bool chooses() const;
    std::uint32_t substeps(const Program& program, std::uint32_t stage) const;
    RateBounds bounds() const;
    StepChoice choose(std::int64_t step);
    const StepProblem& problem_of(std::uint32_t stages);
    bool has_ended(double t);

    const Stage& stage_;
    StageState& state_;
    StageTools tools_;
    std::uint32_t species_;
    bool uniform_speed_;
    double speed_;      ///< The item's value; 1 where it varies by cell.
    double duration_;   ///< Infinite where there is none.
    NumberSource bounds_by_rule_;  ///< Of RateBounds; none where there is no rule.
    bool jumps_ = false;           ///< Do rates jump at thresholds?
    std::map<std::uint32_t, StepProblem> problems_;  ///< By the number of stages.
};

/// Is each step of a stage as long as its item `speed` says, which may vary by cell?
bool steps_by_item(const Stage& stage);

/// The duration of a stage that has started; infinite where it has none.
double duration_of(const Stage& stage, const System& system, const StageState& state);

}  // namespace cascade
