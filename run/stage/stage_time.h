// Decides how a stage advances in time: the passes of its solver, the length of steps, and the end.
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

/// The largest number of parts into which a step is divided, on a model or in a stage with a size.
inline constexpr std::uint32_t most_substeps = 10000;

/// Computes numbers from the present values.
using NumberSource = std::function<std::vector<double>()>;

/// The functions through which a stage's timer reads the simulation. All of them read the present
/// values.
struct StageTools {
    std::function<StepProblem(const Scheme&)> bind;
    /// Returns a function that computes uniform formulas. It may be called repeatedly.
    std::function<NumberSource(std::span<const Formula* const>)> numbers;
    /// Returns the values, as a function of time, of a formula that contains only constants and
    /// `t`.
    std::function<ValueAt(const Formula&)> at_time;
    /// Returns the argument of Forcing::add_motion() for a formula that reads `t` and positions.
    std::function<std::vector<double>(const Formula&, double duration)> motion;
    /// Returns whether the condition of the stage's `until` is true.
    std::function<bool()> condition_holds;
    /// Estimates a bound of the eigenvalues by a power iteration. Used if there is no rule for
    /// bounds.
    std::function<double()> estimate;
    const Mask* inside = nullptr;  ///< The cells that belong to the domain. Null if all cells do.
    const ModelFacts* model = nullptr;  ///< Null on grids.
};

class StageTimer {
public:
    /// `state` is the state of the stage. If the stage has taken no step or has no stored step
    /// control, its step control begins anew.
    StageTimer(const Program& program, std::uint32_t stage, StageState& state, StageTools tools);

    /// Returns the number of parts into which each step is divided so that it is stable on the
    /// cells of a model or with a size.
    std::uint32_t substeps() const {
        return stage_.time.solver == Solver::euler ? state_.time.stages : 0;
    }
    /// Returns the number of stages of Runge-Kutta-Legendre that replace this number of parts, or 0
    /// if the parts are not replaced.
    static std::uint32_t stages_for_parts(std::uint32_t parts);
    /// Returns the scheme of an Euler step that is divided into at least 2 parts, or the scheme of
    /// the stages that replace these parts.
    static Scheme split_scheme(std::uint32_t species, std::uint32_t parts);
    /// Returns the passes of the first step, bound to the stage's values.
    const StepProblem& problem();
    /// Returns a schedule that is complete except for its threads. Schedule explains `interval`.
    Schedule schedule(std::int64_t last_step, std::int64_t interval);

private:
    bool chooses() const;
    bool chooses_by_error() const;
    std::uint32_t substeps(const Program& program, std::uint32_t stage) const;
    RateBounds bounds() const;
    Forcing forcing(const Program& program, std::uint32_t stage) const;
    void set_first_step();
    double expected_duration()
        const;  ///< Returns a duration that is finite even if only `until` ends the stage.
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
    /// Whether the stage continues without the stored state of its step control, for example after
    /// an edit of the script.
    bool begins_anew_ = false;
    bool uniform_speed_;
    double speed_;     ///< The value of `speed`, or 1 if it varies by cell.
    double duration_;  ///< Infinity if the stage has no duration.
    /// Limits steps by changes in time. Used only if the solver chooses the length of steps.
    Forcing forcing_;
    NumberSource bounds_by_rule_;  ///< Computes RateBounds. Null if there is no rule for them.
    bool jumps_ = false;           ///< Whether rates jump where values cross thresholds.
    /// The problems of steps, by the number of stages and by whether the error of the step is
    /// estimated.
    std::map<std::pair<std::uint32_t, bool>, StepProblem> problems_;
};

/// Whether the item `speed` gives the length of each step. It may vary by cell.
bool steps_by_item(const Stage& stage);

/// Whether the error of every step is estimated.
bool judges_all_steps(const Stage& stage);

/// Returns the duration of a started stage, or infinity if it has none.
double duration_of(const Stage& stage, const System& system, const StageState& state);

}  // namespace cascade
