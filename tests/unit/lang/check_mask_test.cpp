// The checker makes the right programs of correct scripts with a mask. tests/scripts/domain tests
// wrong scripts.
#include "check_helpers.h"
#include "lang/lower/lower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

using ::testing::HasSubstr;

TEST(CheckMask, WhatAMaskIsMadeOf) {
    for (const char* mask :
         {"disc(0.5, 0.5, 0.4)", "x^2 + sy > z and sz < 1", "noise(0.2, 3) > 0", "random(0, 1)",
          "image(\"leaf.png\") > 0.5", "field(\"m.npy\")", "not lattice(0.2, 0.05)", "1"}) {
        const auto checked = check_text(std::string("domain { mask: ") + mask + " }" + any_stage);
        ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        EXPECT_TRUE(checked->program->domain.mask);
        EXPECT_EQ(plan_mask(*checked->program).passes.size(), 1u);
    }
}

TEST(CheckMask, ItIsPrintedWithTheProgram) {
    const auto checked =
        check_text(std::string("domain { mask: x < 0.5 or disc(1, 1, 0.2) }") + any_stage);
    ASSERT_TRUE(checked->program);
    EXPECT_THAT(print_program(*checked->program),
                HasSubstr("\n  mask: x < 0.5 or disc(1, 1, 0.2)\n"));
}

}  // namespace
}  // namespace cascade::test
