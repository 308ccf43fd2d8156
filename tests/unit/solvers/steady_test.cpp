// When a pattern counts as settled, on fields whose change is known.
#include "solvers/steady.h"

#include "solvers/field_norms.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using test::only_species;

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
    EXPECT_NEAR(moments_of_difference(field, other).root_mean_square, 0.25, 1e-6);
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

TEST(FieldNorms, OfADifferenceTellShiftFromShape) {
    const Field field = make(64, [](double x, double y) { return 1000 + 0.01 * wave(x, y); });
    const Field other = make(64, [](double x, double y) { return 1003 + 0.03 * wave(x, y); });
    const FieldMoments found = moments_of_difference(other, field);
    EXPECT_NEAR(found.mean, 3, 1e-4);
    EXPECT_NEAR(found.deviation, 0.01, 2e-4);
    EXPECT_NEAR(found.root_mean_square, 3, 1e-4);
}

/// The time at which a pattern given as a function of time counts as settled, or 0 if it has not
/// settled by t = `last`. It is checked every `interval` from t = 0.
double end_of(std::int64_t side, double interval, double last, double tolerance,
              const std::function<double(double t, double x, double y)>& value) {
    const auto state = [&](double t) {
        return only_species(make(side, [&](double x, double y) { return value(t, x, y); }));
    };
    SteadyWatch watch;
    watch.begin(state(0));
    for (double t = interval; t <= last; t += interval) {
        if (watch.settled(state(t), t, tolerance)) return t;
    }
    return 0;
}

/// An amplitude that grows from 1e-4 to 1 at the rate 0.01. It is 1/2 at t = 921, and at t = 921 +
/// 363 its speed is a tenth of its speed at t = 921.
double amplitude(double t) { return 1 / (1 + 9999 * std::exp(-0.01 * t)); }

TEST(Steady, EndsBehindTheGrowthWhateverTheGridAndTheLooks) {
    const auto value = [](double t, double x, double y) { return 4 + amplitude(t) * wave(x, y); };
    for (const std::int64_t side : {32, 64, 200}) {
        for (const double interval : {10.0, 40.0, 100.0}) {
            const double end = end_of(side, interval, 5000, 0.1, value);
            EXPECT_GT(end, 1200) << side << ' ' << interval;
            EXPECT_LE(end, 1400) << side << ' ' << interval;
        }
    }
}

TEST(Steady, DoesNotWaitForWhatGoesOnMoving) {
    // After its growth the pattern drifts at a hundredth of the speed of its formation. After twice
    // the time, it has changed altogether.
    const auto value = [](double t, double x, double y) {
        return 4 + amplitude(t) * wave(x + 1e-5 * t, y);
    };
    const double end = end_of(64, 40, 5000, 0.2, value);
    EXPECT_GT(end, 1000);
    EXPECT_LT(end, 1400);
}

TEST(Steady, GrowthHiddenBelowFadingNoiseIsWaitedFor) {
    // A chequered noise of amplitude 0.1 fades as 1/t, while a pattern grows from 1e-4.
    const auto value = [](double t, double x, double y) {
        const double noise = std::sin(1e4 * (x + 3 * y * y));
        return 4 + 0.1 * noise / (1 + t / 10) + amplitude(t) * wave(x, y);
    };
    for (const double tolerance : {0.5, 0.2, 0.05}) {
        EXPECT_GT(end_of(64, 40, 5000, tolerance, value), 950) << tolerance;
    }
}

TEST(Steady, GrowthHiddenBelowASwingOfTheMeanIsWaitedFor) {
    const auto value = [](double t, double x, double y) {
        return 4 + std::exp(-0.01 * t) * std::cos(0.013 * t) + amplitude(t) * wave(x, y);
    };
    const double end = end_of(64, 40, 5000, 0.2, value);
    EXPECT_GT(end, 1000);
    EXPECT_LT(end, 1500);
}

TEST(Steady, AFrontIsWaitedForWhileItSpreads) {
    // A front that crosses the plane until t = 4000.
    const auto value = [](double t, double x, double) {
        return 0.5 * (1 - std::tanh(20 * (x - 0.05 - t / 4000)));
    };
    const double end = end_of(64, 40, 8000, 0.3, value);
    EXPECT_GT(end, 3600);
    EXPECT_LT(end, 4500);
}

TEST(Steady, WhatFadesEndsWhenLittleIsLeftToFade) {
    // A pattern that was there from the start and comes to rest: speed 0.01 · exp(−t / 100).
    const auto value = [](double t, double x, double y) {
        return 4 + (1 + std::exp(-0.01 * t)) * wave(x, y);
    };
    const double end = end_of(64, 20, 5000, 0.2, value);
    EXPECT_GT(end, 160);
    EXPECT_LT(end, 600);
}

TEST(Steady, WhatDoesNotChangeIsSettledAtTheFirstLook) {
    const auto nothing = [](double, double, double) { return 0.0; };
    const auto pattern = [](double, double x, double y) { return wave(x, y); };
    EXPECT_EQ(end_of(16, 100, 1000, 0.01, nothing), 100);
    EXPECT_EQ(end_of(16, 100, 1000, 0.01, pattern), 100);
}

TEST(Steady, WithoutABeginningTheFirstLookJudgesNothing) {
    SteadyWatch watch;
    const auto state = only_species(make(16, wave));
    EXPECT_FALSE(watch.settled(state, 100, 0.01));
    EXPECT_TRUE(watch.settled(state, 200, 0.01));
}

TEST(Steady, WavesAndSwingsNeverSettle) {
    const auto travels = [](double t, double x, double y) { return wave(x + 0.003 * t, y); };
    const auto swings = [](double t, double, double) { return std::sin(0.0371 * t); };
    EXPECT_EQ(end_of(32, 100, 10000, 0.5, travels), 0);
    EXPECT_EQ(end_of(32, 100, 10000, 0.5, swings), 0);
}

TEST(Steady, EverySpeciesCounts) {
    SteadyWatch watch;
    const auto at = [](double t) {
        std::vector<Field> both = only_species(make(16, wave));
        both.push_back(make(16, [=](double x, double y) { return amplitude(t) * wave(x, y); }));
        return both;
    };
    watch.begin(at(0));
    double end = 0;
    for (double t = 50; t < 3000 && end == 0; t += 50) {
        if (watch.settled(at(t), t, 0.1)) end = t;
    }
    EXPECT_GT(end, 1200);
    EXPECT_LT(end, 1400);
}

}  // namespace
}  // namespace cascade
