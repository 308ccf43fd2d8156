// Checks a text that may have errors, and lowers correct ones. Finds crashes, failed CHECKs and
// refusals without a message.
#pragma once

#include "check_helpers.h"
#include "lang/lower/lower.h"

namespace cascade::test {

inline void lower_all_stages(const Program& program) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        plan_uniform_start(program, stage);
        plan_start(program, stage);
        plan_step(program, stage);
        plan_rates(program, stage);
        plan_view(program, program.stages[stage].show, stage);
    }
}

/// True if the text is a program.
inline bool is_checked_soundly(const std::string& text) {
    const auto checked = check_text(text);
    const bool is_right = checked->program && !checked->diagnostics.has_errors();
    EXPECT_TRUE(is_right || checked->diagnostics.has_errors()) << text;
    if (is_right) lower_all_stages(*checked->program);
    return is_right;
}

}  // namespace cascade::test
