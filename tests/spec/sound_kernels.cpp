// See sound_kernels.h.
#include "tests/spec/sound_kernels.h"

#include "lang/lower.h"

#include <gtest/gtest.h>

namespace cascade {

void expect_sound_kernels(const Program& program) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        for (const auto lower :
             {lower_uniform_start, lower_cell_start, lower_step, lower_rates}) {
            EXPECT_EQ(verify(lower(program, stage).kernel), "") << "stage " << stage + 1;
        }
        const BoundKernel shown = lower_view(program, program.stages[stage].show, stage);
        EXPECT_EQ(verify(shown.kernel), "") << "what stage " << stage + 1 << " shows";
    }
}

}  // namespace cascade
