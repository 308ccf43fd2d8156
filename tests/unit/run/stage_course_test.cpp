// What the few remembered moments of a stage tell about its course.
#include "run/stage/stage_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace cascade {
namespace {

/// One species on 64 × 4 cells: a cosine of this mean and amplitude.
std::vector<Field> species(double mean, double amplitude) {
    std::vector<Field> fields;
    Field field{PlaneLayout(Grid{64, 4})};
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 64; ++i) {
            field.at(i, j) = static_cast<float>(
                mean + amplitude * std::cos(0.0981747704 * static_cast<double>(i)));
        }
    }
    fields.push_back(std::move(field));
    return fields;
}

/// One species on 512 × 256 cells, all with the value `value`, except one cell with `of_cell`.
std::vector<Field> one_cell(float value, float of_cell) {
    std::vector<Field> fields;
    Field& field = fields.emplace_back(PlaneLayout(Grid{512, 256}));
    for (std::int64_t row = 0; row < 256; ++row) std::fill_n(field.row(row), 512, value);
    field.at(77, 130) = of_cell;
    return fields;
}

/// The course of a stage of 1000 steps whose amplitude is a function of the time. Moments are
/// remembered as in a run.
StageCourse course_of(double mean, const std::function<double(double)>& amplitude) {
    StageCourse course;
    for (std::int64_t step = 0; step <= 1000; step += 10) {
        if (step < 1000 && !course.is_due(step)) continue;
        course.look(step, static_cast<double>(step),
                    species(mean, amplitude(static_cast<double>(step))), nullptr);
    }
    return course;
}

TEST(StageCourse, EndsWhereItEnds) {
    const StageCourse course = course_of(2, [](double t) { return t / 1000; });
    EXPECT_EQ(course.first().step, 0);
    EXPECT_TRUE(course.first().is_uniform);
    EXPECT_EQ(course.last().step, 1000);
    EXPECT_FALSE(course.ended_uniform());
    EXPECT_NEAR(course.last().species[0].deviation(), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(course.greatest_contrast(), std::sqrt(0.5) / 3, 1e-3);
}

TEST(StageCourse, ASingleCellOfALargePlaneMakesItUneven) {
    const auto is_uniform = [](float value, float of_cell) {
        StageCourse course;
        course.look(0, 0, one_cell(value, of_cell), nullptr);
        return course.first().is_uniform;
    };
    constexpr float infinite = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(is_uniform(0, 0));
    EXPECT_TRUE(is_uniform(3, 3));
    EXPECT_TRUE(is_uniform(3, 3.001f));
    EXPECT_FALSE(is_uniform(3, 4));
    EXPECT_FALSE(is_uniform(0, 1e-3f));
    EXPECT_TRUE(is_uniform(3, infinite)) << "what is not finite does not count";
}

TEST(StageCourse, AmplitudeThatRisesIsGrowing) {
    const StageCourse course = course_of(2, [](double t) { return 1e-3 * std::exp(t / 300); });
    EXPECT_EQ(course.trend(), Trend::growing);
    EXPECT_NEAR(course.growth(0), std::exp(1.0 / 3) - 1, 0.02);
    EXPECT_EQ(course_of(2, [](double t) { return 1e-4 * t; }).trend(), Trend::growing);
}

TEST(StageCourse, PatternsThatAreThereAreNot) {
    EXPECT_EQ(course_of(2, [](double t) { return std::tanh(t / 200); }).trend(), Trend::none);
    // Coarsening, a pulse that happens to rise, and a pattern that decays slowly.
    EXPECT_EQ(course_of(2, [](double t) { return std::cbrt(t); }).trend(), Trend::none);
    EXPECT_EQ(course_of(2, [](double t) { return 1 + 0.5 * std::sin(t / 20); }).trend(),
              Trend::none);
    EXPECT_EQ(course_of(2, [](double t) { return std::exp(-t / 300); }).trend(), Trend::none);
}

TEST(StageCourse, SmallRestsThatFallAreFading) {
    const StageCourse course = course_of(3.7, [](double t) { return 0.5 * std::exp(-t / 120); });
    EXPECT_EQ(course.trend(), Trend::fading);
    // A small amplitude that stays is a faint pattern.
    EXPECT_EQ(course_of(3.7, [](double t) { return 1e-4 + 0.5 * std::exp(-t / 30); }).trend(),
              Trend::none);
}

TEST(StageCourse, EvenSinceTheFirstOfTheEvenMoments) {
    const StageCourse course = course_of(1, [](double t) { return t < 400 ? 0.2 : 0; });
    ASSERT_TRUE(course.ended_uniform());
    EXPECT_GE(course.uniform_since().step, 400);
    EXPECT_LE(course.uniform_since().step, 450);
    EXPECT_EQ(course.trend(), Trend::none);
}

TEST(StageCourse, SomethingSmallBetweenTheRowsLookedAtIsSeen) {
    std::vector<Field> fields;
    fields.emplace_back(PlaneLayout(Grid{512, 512}));
    StageCourse course;
    course.look(0, 0, fields, nullptr);
    EXPECT_TRUE(course.last().is_uniform);
    fields[0].at(100, 101) = 1;
    course.look(1, 1, fields, nullptr);
    EXPECT_FALSE(course.last().is_uniform);
}

TEST(StageCourse, CellsOutsideOfAMaskDoNotCount) {
    const std::vector<Field> fields = species(1, 0.5);
    Mask inside(fields[0].layout());
    inside.at(3, 1) = 1;
    StageCourse course;
    course.look(0, 0, fields, &inside);
    EXPECT_EQ(course.last().species[0].count, 1);
    EXPECT_TRUE(course.last().is_uniform);
}

}  // namespace
}  // namespace cascade
