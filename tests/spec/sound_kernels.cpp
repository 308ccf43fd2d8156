// See sound_kernels.h.
#include "tests/spec/sound_kernels.h"

#include "lang/lower/lower.h"

#include <gtest/gtest.h>

namespace cascade {

void expect_sound_kernels(const Program& program) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        for (const StepPlan& plan : {plan_uniform_start(program, stage), plan_start(program, stage),
                                     plan_step(program, stage), plan_rates(program, stage),
                                     plan_view(program, program.stages[stage].show, stage)}) {
            for (const Pass& pass : plan.passes) {
                EXPECT_EQ(verify(*pass.bound.kernel), "") << "stage " << stage + 1;
            }
        }
    }
}

}  // namespace cascade
