// The checker makes the right programs of correct scripts with a surface as domain.
// tests/scripts/domain tests wrong scripts.
#include "check_helpers.h"
#include "lang/program/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

TEST(CheckSurface, APositionIsThreeFormulas) {
    const auto checked = check_text(
        std::string("domain {\n  grid: 32, 16\n  surface: cos(2*pi*sx), sin(2*pi*sx), 3 * sy\n"
                    "  metric: 0\n  unit: 1/20\n}") +
        any_stage);
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
    const auto checked = check_text(std::string("domain { surface: sx, sy, 0 }") + any_stage);
    ASSERT_TRUE(checked->program);
    EXPECT_TRUE(checked->program->domain.surface->has_metric);
    EXPECT_FALSE(checked->program->domain.surface->unit);
}

}  // namespace
}  // namespace cascade::test
