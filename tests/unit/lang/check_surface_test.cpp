// Domains on a surface: what is read, what is refused.
#include "check_helpers.h"
#include "lang/program/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;

constexpr const char* stage = "\nsystem_name: turing_spots\n";

std::vector<std::string> faults(const std::string& domain) {
    return check_text("domain { " + domain + " }" + stage)->faults();
}

TEST(CheckSurface, APositionIsThreeFormulas) {
    const auto checked = check_text(
        std::string("domain {\n  grid: 32, 16\n  surface: cos(2*pi*sx), sin(2*pi*sx), 3 * sy\n"
                    "  metric: 0\n  unit: 1/20\n}") +
        stage);
    ASSERT_TRUE(checked->program) << ::testing::PrintToString(checked->faults());
    const auto& surface = checked->program->domain.surface;
    ASSERT_TRUE(surface);
    EXPECT_FALSE(surface->has_metric);
    EXPECT_EQ(surface->unit, 0.05);
    BuiltinValues place{};
    place[static_cast<std::size_t>(Builtin::sx)] = 0.125;
    place[static_cast<std::size_t>(Builtin::sy)] = 0.5;
    EXPECT_DOUBLE_EQ(evaluate(surface->position[0], place), std::cos(std::numbers::pi / 4));
    EXPECT_DOUBLE_EQ(evaluate(surface->position[1], place), std::sin(std::numbers::pi / 4));
    EXPECT_DOUBLE_EQ(evaluate(surface->position[2], place), 1.5);
}

TEST(CheckSurface, ByDefaultItHasItsMetricAndNoUnit) {
    const auto checked = check_text(std::string("domain { surface: sx, sy, 0 }") + stage);
    ASSERT_TRUE(checked->program);
    EXPECT_TRUE(checked->program->domain.surface->has_metric);
    EXPECT_FALSE(checked->program->domain.surface->unit);
}

TEST(CheckSurface, WrongForms) {
    EXPECT_THAT(faults("surface: sx, sy"),
                ElementsAre("1:10: a surface is three expressions: x, y and z in space | surface: "
                            "sx, sy, 0.1 * sin(2 * pi * sx)"));
    EXPECT_THAT(faults("surface: sx, sy, t"),
                ElementsAre("1:27: a surface cannot depend on 't' | it stays as it is"));
    EXPECT_THAT(faults("surface: sx, sy, beta"),
                ElementsAre("1:27: a surface knows nothing of 'beta' | it is made of numbers, sx, "
                            "sy, pi and functions of them"));
    EXPECT_THAT(faults("surface: sx, sy, random(0, 1)"),
                ElementsAre("1:27: random cannot stand here | a surface is made of numbers, sx, "
                            "sy and functions of numbers"));
    EXPECT_THAT(faults("surface: sx, sy, 0; unit: 0"),
                ElementsAre("1:36: the unit of length must be above 0"));
    EXPECT_THAT(faults("metric: 0"),
                ElementsAre("1:10: only a domain with a surface has this setting | surface: x, y, "
                            "z"));
    EXPECT_THAT(faults("grid: 50; surface: sx, sy, 0"),
                ElementsAre("1:20: a surface needs a grid of two axes | grid: 128, 128"));
    EXPECT_THAT(faults("surface: sx, sy, 0; surface: sx, sy, 1"),
                ElementsAre("1:30: 'surface' is given a value twice"));
}

TEST(CheckSurface, OperatorsOfTheGridAreRefused) {
    const auto rate = [](const std::string& formula, const std::string& domain) {
        return check_text("domain { surface: sx, sy, 0; " + domain +
                          " }\nsystem s { u: 0; u' = " + formula + " }\nstage a: s { }\n")
            ->faults();
    };
    const char* hint =
        " | second derivatives by name have no meaning on a surface; lap and div have";
    EXPECT_THAT(rate("dxx(u)", ""), ElementsAre(std::string("2:23: dxx cannot stand here") + hint));
    EXPECT_THAT(rate("dxx(u)", "metric: 0"), ::testing::IsEmpty());
    EXPECT_THAT(rate("dx(u) + dy(u) + lap(u)", ""), ::testing::IsEmpty());
    EXPECT_THAT(rate("div(tensor(1, 2, 0) * (vector(u, 0) - 2 * (tensor(1, 2, 0) * grad(u))))", ""),
                ElementsAre("2:27: on a surface a tensor cannot multiply what a tensor has "
                            "multiplied | make one tensor of the two"));
    EXPECT_THAT(rate("div(tensor(1, 2, 0) * (tensor(1, 2, 0) * grad(u)))", "metric: 0"),
                ::testing::IsEmpty());
    EXPECT_THAT(rate("lap(u)", "metric: 0.5"), ElementsAre("1:38: metric is 0 or 1"));
    EXPECT_THAT(rate("lap(u)", "spacing: 2"),
                ElementsAre("1:10: a domain has a surface or a spacing, not both | unit: … is the "
                            "length of one unit on a surface"));
}

}  // namespace
}  // namespace cascade::testing
