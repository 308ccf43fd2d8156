// A stage that runs. Everything that its steps need lives from its start to its end: kernels, bound
// passes, step-invariants, the copies of its species, threads, and measurements of their speed.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/stage_view.h"
#include "run/simulation/undefined_values.h"
#include "run/stage/kept_tilings.h"
#include "run/stage/stage_time.h"
#include "run/stage/step_kernels.h"
#include "solvers/advance.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace cascade {

/// When and how the state of a run is kept while steps are taken; never without `is_due`.
struct Keeping {
    std::function<bool()> is_due;
    std::function<void()> keep;
};

/// The run of one stage that has been started. While it exists, nothing else may change the states
/// of the simulation.
class StageRun {
public:
    /// All must outlive the run.
    StageRun(const Environment& environment, std::span<StageState> states, std::uint32_t stage,
             const Keeping& keeping);
    StageRun(const StageRun&) = delete;
    StageRun& operator=(const StageRun&) = delete;

    std::uint32_t stage() const { return view_.number(); }
    StepKernels& kernels() { return kernels_; }

    /// Like Simulation::advance_stage.
    Result<StageEnd> advance(std::int64_t last_step, RunControl& control,
                             const std::function<void()>& observe, std::int64_t every);
    /// May it be called again? Not after the end of the stage, a failure or a cancellation, nor if
    /// doubts were looked for: their checks reuse the stage's memory.
    bool can_go_on() const { return can_go_on_; }

private:
    std::optional<Result<StageEnd>> begin(std::int64_t last_step);
    bool is_frozen() const;
    StageEnd end_frozen(std::int64_t last_step);
    Schedule schedule();
    Progress progress() const;
    void look();
    Result<StageEnd> take_steps(std::int64_t last_step, const std::function<void()>& observe,
                                std::int64_t interval);
    void look_for_doubts();
    void account_for(std::int64_t steps, const StageOutcome& outcome) const;

    StepInvariants invariants_;
    StageView view_;
    std::span<StageState> states_;
    StageState& state_;
    const Keeping& keeping_;
    StepKernels kernels_;
    UndefinedValues undefined_;
    RunControl* control_ = nullptr;  ///< For the present call.
    StageTimer timer_;
    std::optional<StageTilings> tilings_;
    std::optional<TimeLoop> loop_;  ///< From the first step on.
    bool can_go_on_ = true;
};

}  // namespace cascade
