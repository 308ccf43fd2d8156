// The interface of a stage that runs, either of fields or of crawling cells.
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

/// When and how the state of a run is saved while steps are taken. If `is_due` is empty, the state
/// is never saved.
struct Keeping {
    std::function<bool()> is_due;
    std::function<void()> keep;
};

/// The times at which a stage that runs is observed. See Simulation::advance_stage().
struct Observation {
    std::function<void()> observe;
    std::int64_t every = 0;
    NextMoment next_moment = {};
};

/// The run of a stage that has been started. As long as this object exists, nothing else may change
/// the states of the simulation.
class RunningStage {
public:
    RunningStage() = default;
    virtual ~RunningStage() = default;
    RunningStage(const RunningStage&) = delete;
    RunningStage& operator=(const RunningStage&) = delete;

    virtual std::uint32_t stage() const = 0;
    virtual StepKernels& kernels() = 0;
    /// See Simulation::advance_stage().
    virtual Result<StageEnd> advance(std::int64_t last_step, RunControl& control,
                                     const Observation& observation) = 0;
    /// Whether advance() may be called again. It must not be called again after the end of the
    /// stage, a failure or a cancellation. It must also not be called again after the search for
    /// doubts about the result, which reuses the stage's memory.
    virtual bool can_go_on() const = 0;
};

/// Makes the run of a stage that has been started. The arguments must outlive it.
std::unique_ptr<RunningStage> run_of(const Environment& environment, std::span<StageState> states,
                                     std::uint32_t stage, const Keeping& keeping);

/// Returns the report of progress before the first step of a stage.
Progress progress_of(const Environment& environment, std::uint32_t stage);

}  // namespace cascade
