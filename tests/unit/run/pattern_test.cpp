// The public library.

#include "cascade/cascade.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade {
namespace {

constexpr const char* spots =
    "domain { grid: 20, 12 }\n"
    "stage one: turing_spots { iterations: 30 }\n"
    "stage two: turing_spots { iterations: 20; a: a; b: b; beta: beta }\n";

TEST(Pattern, StepsThroughTheStages) {
    Pattern pattern(spots);
    ASSERT_TRUE(pattern.ok()) << pattern.messages() << pattern.error();
    EXPECT_EQ(pattern.width(), 20);
    EXPECT_EQ(pattern.height(), 12);
    EXPECT_EQ(pattern.stages(), (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(pattern.species("one"), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(pattern.current_stage(), "one");
    EXPECT_EQ(pattern.step(10), 10);
    EXPECT_EQ(pattern.steps(), 10);
    EXPECT_EQ(pattern.step(25), 25);
    EXPECT_EQ(pattern.current_stage(), "two");
    EXPECT_EQ(pattern.steps(), 5);
    EXPECT_EQ(pattern.step(1000), 15);
    EXPECT_TRUE(pattern.finished());
    EXPECT_EQ(pattern.step(1), 0);
}

TEST(Pattern, StepsDoNotDependOnHowTheyAreCounted) {
    Pattern at_once(spots);
    at_once.step(50);
    Pattern one_by_one(spots);
    while (one_by_one.step(1) == 1) {
    }
    EXPECT_EQ(at_once.values("b"), one_by_one.values("b"));
}

TEST(Pattern, ReadsExpressions) {
    Pattern pattern(spots);
    pattern.step(40);
    const auto b = pattern.values("b");
    const auto twice = pattern.values("2 * b - one.b");
    const auto earlier = pattern.values("one.b");
    ASSERT_EQ(b.size(), 240u);
    ASSERT_EQ(twice.size(), 240u);
    for (std::size_t c = 0; c < b.size(); ++c) EXPECT_EQ(twice[c], 2 * b[c] - earlier[c]);
    EXPECT_TRUE(pattern.values("bb").empty());
    EXPECT_NE(pattern.error().find("bb"), std::string::npos);
    EXPECT_TRUE(pattern.ok());
}

TEST(Pattern, TellsWhereAScriptIsWrong) {
    Pattern pattern("stage one: turing_spots { kaa: 1 }\n");
    EXPECT_FALSE(pattern.ok());
    const auto messages = pattern.diagnostics();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_TRUE(messages[0].is_error);
    EXPECT_EQ(messages[0].line, 1);
    EXPECT_EQ(messages[0].column, 27);
    EXPECT_EQ(pattern.step(1), 0);
}

TEST(Pattern, TellsWhyARunFailed) {
    Pattern pattern(
        "system bomb { u: 1; u' = u * u * u }\n"
        "stage one: bomb { iterations: 1000 }\n");
    ASSERT_TRUE(pattern.ok());
    EXPECT_LT(pattern.step(1000), 1000);
    EXPECT_FALSE(pattern.ok());
    EXPECT_NE(pattern.error().find("not finite"), std::string::npos);
}

TEST(Pattern, IsTheSameInterpretedAndCompiled) {
    PatternOptions interpreted;
    interpreted.native_code = false;
    Pattern first(spots, interpreted);
    Pattern second(spots);
    first.step(50);
    second.step(50);
    EXPECT_EQ(first.values("a"), second.values("a"));
}

}  // namespace
}  // namespace cascade
