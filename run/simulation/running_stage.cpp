// What all stages report alike.
#include "run/simulation/running_stage.h"

namespace cascade {

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
