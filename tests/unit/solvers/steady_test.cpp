// When a pattern counts as settled, on fields whose change is known.
#include "solvers/steady.h"

#include "solvers/field_norms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace cascade {
namespace {

Field make(std::int64_t side, const std::function<double(double, double)>& value) {
    Field field{PlaneLayout(Grid{side, side})};
    for (std::int64_t j = 0; j < side; ++j) {
        for (std::int64_t i = 0; i < side; ++i) {
            const auto part = [&](std::int64_t n) {
                return static_cast<double>(n) / static_cast<double>(side);
            };
            field.at(i, j) = static_cast<float>(value(part(i), part(j)));
        }
    }
    return field;
}

std::vector<Field> one(Field field) {
    std::vector<Field> fields;
    fields.push_back(std::move(field));
    return fields;
}

double wave(double x, double y) {
    return std::sin(4 * std::numbers::pi * x) * std::cos(6 * std::numbers::pi * y);
}

TEST(FieldNorms, AreThoseOfAWave) {
    const Field field = make(50, [](double x, double y) { return 3 + 2 * wave(x, y); });
    const FieldMoments found = moments(field);
    EXPECT_NEAR(found.mean, 3, 1e-6);
    EXPECT_NEAR(found.deviation, 1, 1e-6);
    EXPECT_NEAR(found.root_mean_square, std::sqrt(10.0), 1e-6);
    const Field other = make(50, [](double x, double y) { return 3 + 2.5 * wave(x, y); });
    EXPECT_NEAR(root_mean_square_of_difference(field, other), 0.25, 1e-6);
}

TEST(FieldNorms, KnowWavesOfSmallAmplitudeOnLargeMeans) {
    const Field field = make(64, [](double x, double y) { return 1000 + 0.01 * wave(x, y); });
    EXPECT_NEAR(moments(field).deviation, 0.005, 2e-4);
}

TEST(FieldNorms, DoNotHideNaN) {
    Field field = make(16, wave);
    field.at(3, 5) = NAN;
    EXPECT_TRUE(std::isnan(root_mean_square(field)));
}

TEST(Steady, TheRateIsThatOfTheGrowthWhateverTheGrid) {
    for (const std::int64_t side : {32, 64, 200}) {
        const auto at = [&](double t) {
            return one(make(side, [=](double x, double y) { return 4 + std::exp(0.01 * t) * wave(x, y); }));
        };
        EXPECT_NEAR(relative_change_rate(at(0), at(1), 1), 0.01, 2e-4) << side;
    }
}

TEST(Steady, GoesOnThroughGrowthAndEndsBehindIt) {
    // A logistic amplitude from 1e-4 to 1, at the rate 0.01: half of it is reached at t = 921.
    SteadyWatch watch;
    double ended = 0;
    for (double t = 0; t < 5000 && ended == 0; t += 100) {
        const double amplitude = 1 / (1 + 9999 * std::exp(-0.01 * t));
        const auto state = one(make(64, [=](double x, double y) { return 4 + amplitude * wave(x, y); }));
        if (watch.settled(state, t, 0.01)) ended = t;
    }
    EXPECT_GT(ended, 1700);
    EXPECT_LT(ended, 2600);
}

TEST(Steady, WhatDoesNotChangeIsSettledAtTheSecondLook) {
    SteadyWatch watch;
    const auto state = one(make(16, [](double, double) { return 0.0; }));
    EXPECT_FALSE(watch.settled(state, 0, 0.01));
    EXPECT_TRUE(watch.settled(state, 100, 0.01));
}

TEST(Steady, AWaveThatTravelsNeverSettles) {
    SteadyWatch watch;
    for (double t = 0; t < 10000; t += 100) {
        const auto state = one(make(32, [=](double x, double y) { return wave(x + 0.003 * t, y); }));
        EXPECT_FALSE(watch.settled(state, t, 0.01)) << t;
    }
}

}  // namespace
}  // namespace cascade
