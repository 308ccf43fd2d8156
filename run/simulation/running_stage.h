// A stage that runs, of fields or of cells that crawl.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/simulation/simulation.h"
#include "run/stage/stage_state.h"
#include "run/stage/step_kernels.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace cascade {

/// When and how the state of a run is kept while steps are taken; never without `is_due`.
struct Keeping {
    std::function<bool()> is_due;
    std::function<void()> keep;
};

/// When a stage is observed, as Simulation::advance_stage() says.
struct Observation {
    std::function<void()> observe;
    std::int64_t every = 0;
    NextMoment next_moment = {};
};

/// The run of one stage that has been started. While it exists, nothing else may change the states
/// of the simulation.
class RunningStage {
public:
    RunningStage() = default;
    virtual ~RunningStage() = default;
    RunningStage(const RunningStage&) = delete;
    RunningStage& operator=(const RunningStage&) = delete;

    virtual std::uint32_t stage() const = 0;
    virtual StepKernels& kernels() = 0;
    /// Like Simulation::advance_stage.
    virtual Result<StageEnd> advance(std::int64_t last_step, RunControl& control,
                                     const Observation& observation) = 0;
    /// May it be called again? Not after the end of the stage, a failure or a cancellation, nor if
    /// doubts were looked for: their checks reuse the stage's memory.
    virtual bool can_go_on() const = 0;
};

/// The run of a stage that has been started. The arguments must outlive it.
std::unique_ptr<RunningStage> run_of(const Environment& environment, std::span<StageState> states,
                                     std::uint32_t stage, const Keeping& keeping);

/// What is reported of a stage before it has taken a step.
Progress progress_of(const Environment& environment, std::uint32_t stage);

}  // namespace cascade
