// Scripts that are very deep or long, or would be after expansion of functions and families.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> faults(const std::string& text) { return check_text(text)->faults(); }

TEST(LargeScripts, MayBeDeepAndLong) {
    std::string deep = "system_name: turing_spots\nka: ";
    for (int i = 0; i < 100'000; ++i) deep += "1-(";
    deep += "q" + std::string(100'000, ')');
    EXPECT_THAT(faults(deep),
                ElementsAre("2:300005: 'q' reads the previous stage, but this is the first "
                            "stage"));
    std::string chain = "system_name: turing_spots\nka: 1";
    for (int i = 1; i < 1'000'000; ++i) chain += "+1";
    EXPECT_THAT(faults(chain), IsEmpty());
    std::string names = "system s { a: 1; a' = p0\n";
    for (int i = 0; i < 100'000; ++i) names += fmt::format("p{}: p{}\n", i, i + 1);
    names += "p100000: 1 }\nstage one: s {}";
    EXPECT_THAT(faults(names), IsEmpty());
}

TEST(LargeScripts, AreBoundedWhenWrittenOut) {
    std::string doubling = "fn f0(x) = x + 1\n";
    for (int i = 1; i < 60; ++i) {
        doubling += fmt::format("fn f{}(x) = f{}(x) + f{}(x)\n", i, i - 1, i - 1);
    }
    const std::string large =
        "this expression is too large after its functions and families are written out | a "
        "script may grow to 1000000 parts";
    EXPECT_THAT(faults(doubling + "system s { u: f59(1); u' = f59(2) }"),
                ElementsAre("61:15: " + large));
    EXPECT_THAT(faults("system s { i: 1..1000; u: 1\n"
                       "u' = sum(sum(sum(i over i) over i) over i) }"),
                ElementsAre("2:6: " + large));
    std::string families = "system s { i: 1..1000; u: 1; u' = 1\n";
    for (int k = 0; k < 200; ++k) families += fmt::format("p{}[i]: 1\n", k);
    EXPECT_THAT(faults(families + "}").at(0),
                "101:1: the families of s are too large in total | "
                "a system has at most 100000 statements");
    // A chain of functions with a million parts overflows no stack.
    std::string chain = "fn f0(x) = x\n";
    for (int i = 1; i < 20'000; ++i) chain += fmt::format("fn f{}(x) = f{}(x) + 1\n", i, i - 1);
    EXPECT_THAT(faults(chain + "system s { u: f19999(1); u' = 1 }"), IsEmpty());
    std::string bases = "system b0 { u: 1; u' = 1 }\n";
    for (int i = 1; i < 1000; ++i)
        bases += fmt::format("system b{}: b{} {{ u: {} }}\n", i, i - 1, i);
    EXPECT_THAT(faults(bases), IsEmpty());
    std::string long_chain = "system b0 { u: 1; u' = 1 }\n";
    for (int i = 1; i < 3000; ++i)
        long_chain += fmt::format("system b{}: b{} {{ u' += 1 }}\n", i, i - 1);
    EXPECT_THAT(faults(long_chain),
                ElementsAre("1414:15: the systems of this script are too large in total"));
}

TEST(LargeScripts, HaveShortDumps) {
    std::string doubling = "fn f0(x) = x + 1\n";
    for (int i = 1; i < 14; ++i) {
        doubling += fmt::format("fn g{0}(x) = x * x\nfn f{0}(x) = g{0}(f{1}(x))\n", i, i - 1);
    }
    std::string deep = doubling + "fn sq(x) = x * x\nsystem s { u: 1; u' = ";
    for (int i = 0; i < 60; ++i) deep += "sq(";
    deep += "u";
    for (int i = 0; i < 60; ++i) deep += ")";
    const auto checked = check_text(deep + " }\nstage a: s { }");
    ASSERT_THAT(checked->faults(), IsEmpty());
    EXPECT_LT(print_program(*checked->program).size(), 200'000u);
}

}  // namespace
}  // namespace cascade::test
