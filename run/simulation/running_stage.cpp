// Makes the run of a stage of fields or of crawling cells, and the first report of its progress.
#include "run/simulation/running_stage.h"

#include "lang/program/stage_kinds.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/tissue_run.h"

namespace cascade {

std::unique_ptr<RunningStage> run_of(const Environment& environment, std::span<StageState> states,
                                     std::uint32_t stage, const Keeping& keeping) {
    if (is_of_cells(*environment.program, stage))
        return std::make_unique<TissueRun>(environment, states, stage, keeping);
    return std::make_unique<StageRun>(environment, states, stage, keeping);
}

Progress progress_of(const Environment& environment, std::uint32_t stage) {
    const Stage& its = environment.stage(stage);
    Progress progress;
    progress.stage = its.name;
    progress.note = environment.progress_note;
    progress.stage_number = static_cast<int>(stage) + 1;
    progress.stage_count = static_cast<int>(environment.script.stage_count());
    progress.steps = its.iterations;
    progress.when_met = its.time.steady ? "settled" : "'until' came true";
    return progress;
}

}  // namespace cascade
