// Runs a stage of fields. Holds everything that its steps need from the first to the last: kernels,
// bound passes, step-invariants, copies of species, threads, and measurements of speed.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/between_steps.h"
#include "run/simulation/lost_parts.h"
#include "run/simulation/running_stage.h"
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

/// The run of a stage of fields.
class StageRun : public RunningStage {
public:
    /// All arguments must outlive the run.
    StageRun(const Environment& environment, std::span<StageState> states, std::uint32_t stage,
             const Keeping& keeping);

    std::uint32_t stage() const override { return view_.number(); }
    StepKernels& kernels() override { return kernels_; }
    Result<StageEnd> advance(std::int64_t last_step, RunControl& control,
                             const Observation& observation) override;
    bool can_go_on() const override { return can_go_on_; }

private:
    std::optional<Result<StageEnd>> begin(std::int64_t last_step);
    StageEnd end_frozen(std::int64_t last_step);
    Schedule schedule();
    void look();
    Result<StageEnd> reset_after(Failure why);
    Result<StageEnd> take_steps(std::int64_t last_step, const Observation& observation);
    void observe(const Observation& observation);
    void look_for_doubts();
    void account_for(std::int64_t steps, const StageOutcome& outcome) const;

    StepInvariants invariants_;
    StageView view_;
    std::span<StageState> states_;
    StageState& state_;
    const Keeping& keeping_;
    StepKernels kernels_;
    LostParts lost_;
    UndefinedValues undefined_;
    RunControl* control_ = nullptr;  ///< The control of the present call of advance().
    StageTimer timer_;
    std::optional<StageTilings> tilings_;
    NextMoment next_moment_;               ///< The moments of the present call of advance().
    std::optional<BetweenSteps> between_;  ///< Empty if no moments are observed.
    std::optional<TimeLoop> loop_;         ///< Empty before the first step.
    bool can_go_on_ = true;
};

}  // namespace cascade
