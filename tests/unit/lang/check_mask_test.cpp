// Domains with a mask: what is read, what is refused.
#include "check_helpers.h"
#include "lang/lower/lower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* stage = "\nsystem_name: turing_spots\n";

std::vector<std::string> faults(const std::string& domain) {
    return check_text("domain { " + domain + " }" + stage)->faults();
}

TEST(CheckMask, WhatAMaskIsMadeOf) {
    for (const char* mask :
         {"disc(0.5, 0.5, 0.4)", "x^2 + sy > z and sz < 1", "noise(0.2, 3) > 0", "random(0, 1)",
          "image(\"leaf.png\") > 0.5", "field(\"m.npy\")", "not lattice(0.2, 0.05)", "1"}) {
        const auto checked = check_text(std::string("domain { mask: ") + mask + " }" + stage);
        ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
        EXPECT_TRUE(checked->program->domain.mask);
        EXPECT_EQ(plan_mask(*checked->program).passes.size(), 1u);
    }
}

TEST(CheckMask, FunctionsOfOnesOwn) {
    const auto checked = check_text(
        std::string("fn leaf(a) = abs(sy - 0.5) < a * sx * (1 - sx)\ndomain { mask: leaf(1.5) }") +
        stage);
    EXPECT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
}

TEST(CheckMask, ItIsPrintedWithTheProgram) {
    const auto checked =
        check_text(std::string("domain { mask: x < 0.5 or disc(1, 1, 0.2) }") + stage);
    ASSERT_TRUE(checked->program);
    EXPECT_THAT(print_program(*checked->program),
                HasSubstr("\n  mask: x < 0.5 or disc(1, 1, 0.2)\n"));
}

TEST(CheckMask, WrongForms) {
    EXPECT_THAT(faults("mask: a > 1"),
                ElementsAre("1:16: a mask knows nothing of 'a' | it is made of coordinates, "
                            "numbers, shapes, noise and files"));
    EXPECT_THAT(faults("mask: stage1.a"),
                ElementsAre("1:16: a mask knows nothing of 'a' | it is made of coordinates, "
                            "numbers, shapes, noise and files"));
    EXPECT_THAT(faults("mask: x < t"),
                ElementsAre("1:20: a mask cannot depend on 't' | it stays as it is"));
    EXPECT_THAT(faults("mask: lap(x)"),
                ElementsAre("1:16: lap cannot stand here | a mask says which cells the domain has, "
                            "and reads no others"));
    EXPECT_THAT(faults("mask: x > mean(x over domain)"),
                ElementsAre("1:20: mean over domain cannot stand here | a mask says which cells "
                            "the domain has, and reads no others"));
    EXPECT_THAT(faults("mask: rgb(1, 0, 0)"),
                ElementsAre("1:16: rgb cannot stand here | colours belong in pictures"));
    EXPECT_THAT(faults("mask: white(1)"),
                ElementsAre("1:16: white cannot stand here | it belongs in rates and definitions "
                            "of a system"));
    EXPECT_THAT(faults("mask: 1, 2"), ElementsAre(HasSubstr("1:19:")));
    EXPECT_THAT(faults("mask: 1; mask: 2"),
                ElementsAre(HasSubstr("'mask' is given a value twice")));
}

TEST(CheckMask, SpeciesArePeriodicAsTheBoundaryIs) {
    const std::string rest = "stage only: heat { }\n";
    EXPECT_THAT(check_text("system heat { u: 0; u' = lap(u); u.left: noflux; u.right: fixed(1) }\n"
                           "domain { mask: x > 0.5 }\n" +
                           rest)
                    ->faults(),
                ElementsAre("1:34: in a domain with a mask left is periodic for all species or for "
                            "none | the domain's boundary says which: boundary: periodic, noflux"));
    EXPECT_THAT(check_text("system heat { u: 0; u' = lap(u); u.left: flux(2); u.right: fixed(1) }\n"
                           "domain { mask: x > 0.5; boundary: noflux, periodic }\n" +
                           rest)
                    ->faults(),
                ElementsAre());
}

}  // namespace
}  // namespace cascade::testing
