// A stage that runs. Everything that its steps need lives from its start to its end: kernels, bound
// passes, step-invariants, the copies of its species, threads, and measurements of their speed.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/between_steps.h"
#include "run/simulation/lost_products.h"
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
    /// All must outlive the run.
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
    LostProducts lost_;
    UndefinedValues undefined_;
    RunControl* control_ = nullptr;  ///< For the present call.
    StageTimer timer_;
    std::optional<StageTilings> tilings_;
    NextMoment next_moment_;               ///< For the present call.
    std::optional<BetweenSteps> between_;  ///< With moments.
    std::optional<TimeLoop> loop_;         ///< From the first step on.
    bool can_go_on_ = true;
};

}  // namespace cascade
