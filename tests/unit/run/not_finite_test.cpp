#include "run/not_finite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

NotFiniteReport report_of(std::int64_t last_finite, std::int64_t step) {
    NotFiniteReport report;
    report.stage = "s";
    report.system = "gs";
    report.species = "u";
    report.place = "column 1, row 2";
    report.speed = 4;
    report.found.step = step;
    report.found.last_finite = last_finite;
    return report;
}

TEST(NotFinite, NamesTheStep) {
    EXPECT_EQ(describe(report_of(63, 64)).message,
              "stage 's' (gs): u is not finite any more at column 1, row 2, after step 64");
    EXPECT_EQ(describe(report_of(0, 30)).message,
              "stage 's' (gs): u is not finite any more at column 1, row 2, between steps 0 and 30");
    EXPECT_THAT(describe(report_of(7, 7)).message, HasSubstr("the starting value of u is not finite"));
}

// Looks may be one step apart: the step is known then, and the values before it are not.
TEST(NotFinite, SaysNothingOfValuesThatWereNotKept) {
    for (const std::int64_t last_finite : {0, 63}) {
        NotFiniteReport report = report_of(last_finite, 64);
        EXPECT_THAT(describe(report).hint, HasSubstr("a smaller grid"));
        report.estimate_at_start.largest_speed = 1.5;
        EXPECT_THAT(describe(report).hint, HasSubstr("try 'speed: 1.4'"));
    }
    NotFiniteReport kept = report_of(63, 64);
    kept.largest_before = 2;
    EXPECT_THAT(describe(kept).hint, HasSubstr("no value was above 2 before that step"));
    kept.largest_before = 1e9;
    EXPECT_THAT(describe(kept).hint, Not(HasSubstr("no value was above")));
}

}  // namespace
}  // namespace cascade
