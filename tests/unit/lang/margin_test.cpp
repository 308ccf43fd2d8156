// Margins of conditions are above 0 exactly where the conditions are true, and continuous for
// comparisons.
#include "lang/calculus/margin.h"

#include "lower_helpers.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

/// A condition in u, which goes from 0 to 1 over 101 columns, and its margin.
struct Both {
    Field condition, margin;
};

Both both(const std::string& condition) {
    const auto checked =
        check_text("system s {\n u: (sx * 101 - 0.5) / 100\n u' = 0\n show: " + condition +
                   "\n}\nstage one: s { }\ndomain { grid: 101, 1 }\n");
    EXPECT_TRUE(checked->program) << condition << ": " << checked->faults().front();
    ScriptRun run(*checked->program);
    run.start(0);
    const Formula& show = checked->program->stages[0].show;
    return {std::move(run.view(show, 0)[0]), std::move(run.view(margin_of(show), 0)[0])};
}

TEST(Margin, IsAboveZeroWhereTheConditionHolds) {
    for (const char* condition :
         {"u > 0.305", "u < 0.305", "u >= 0.305 and u < 0.705", "not (u > 0.5) or u > 0.755",
          "u > 0.2 and not (u > 0.4 and u < 0.6)", "u == 0.5", "u - 0.5", "1", "0",
          "(u > 0.5) + (u > 0.7) > 1"}) {
        const Both found = both(condition);
        for (std::int64_t i = 0; i < 101; ++i) {
            if (found.margin.at(i, 0) == 0) continue;  // Here the condition changes.
            EXPECT_EQ(found.condition.at(i, 0) != 0, found.margin.at(i, 0) > 0)
                << condition << " at " << i;
        }
    }
}

TEST(Margin, GoesThroughZeroWithoutAJump) {
    const Both found = both("u >= 0.305 and u < 0.705");
    for (std::int64_t i = 0; i + 1 < 101; ++i) {
        EXPECT_NEAR(found.margin.at(i, 0), found.margin.at(i + 1, 0), 0.0101);
    }
    EXPECT_NEAR(found.margin.at(40, 0), 0.095, 1e-6);
}

TEST(Margin, TakesConditionsOfAnyDepth) {
    std::string condition = "u > 0.5";
    for (int k = 0; k < 20000; ++k) condition += " and u > 0.25";
    const Both found = both(condition);
    EXPECT_GT(found.margin.at(60, 0), 0);
    EXPECT_LT(found.margin.at(40, 0), 0);
}

}  // namespace
}  // namespace cascade::test
