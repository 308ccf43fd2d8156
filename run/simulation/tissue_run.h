// Runs a stage of crawling cells.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/simulation/running_stage.h"
#include "run/simulation/stage_view.h"
#include "run/stage/step_kernels.h"
#include "run/tissue/script_rules.h"
#include "tissue/tissue_loop.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace cascade {

class TissueRun : public RunningStage {
public:
    /// All arguments must outlive the run. The stage must have been started.
    TissueRun(const Environment& environment, std::span<StageState> states, std::uint32_t stage,
              const Keeping& keeping);

    std::uint32_t stage() const override { return stage_; }
    StepKernels& kernels() override { return kernels_; }
    Result<StageEnd> advance(std::int64_t last_step, RunControl& control,
                             const Observation& observation) override;
    bool can_go_on() const override { return can_go_on_; }

private:
    TissueSchedule schedule(const Keeping& keeping);
    bool condition_holds();
    void warn_of_waiting(const Tissue& tissue);
    void follow(const Tissue& tissue);

    const Environment& environment_;
    std::span<StageState> states_;
    std::uint32_t stage_;
    StageState& state_;
    StepKernels kernels_;
    RunControl* control_ = nullptr;  ///< The control of the present call of advance().
    Observation observation_;        ///< The observation of the present call of advance().
    std::shared_ptr<NearTriangles> near_ = std::make_shared<NearTriangles>();
    ScriptRules rules_;
    std::optional<TissueLoop> loop_;
    bool can_go_on_ = true;
    /// Whether the run has warned that `until` may never become true.
    bool is_waiting_ = false;
    /// Whether all cells are neighbours of each other and the user has not been warned of it yet.
    bool reaches_all_ = false;
};

/// Explains the failure of a tissue in a step, counted from 1, in the words of its script. The view
/// must show the cells as they were before that step.
Failure explain(const TissueFailure& failure, const StageView& view, std::int64_t step);

}  // namespace cascade
