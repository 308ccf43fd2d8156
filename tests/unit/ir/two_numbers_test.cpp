// Functions of two numbers: the angle of a point, hypotenuse, modulus, smooth step.
#include "tests/support/not_finite.h"
#include "tests/support/random_stream.h"
#include "tests/unit/ir/number_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace cascade {
namespace {

using test::apply_to_all;
using test::error_in_ulp;
using test::flushed;
using test::Form;
using test::infinity;
using test::nan;

struct FunctionOfTwo {
    const char* name;
    ValueId (KernelBuilder::*expand)(ValueId, ValueId);
    double (*exact)(double, double);
    double largest_error;  ///< In ulp, as stated in spec/numerics.md.
};

/// a − b · floor(a / b) in long double, whose 64 bits represent every remainder of such numbers.
double floored_rest(double a, double b) {
    const long double rest = std::fmod(static_cast<long double>(a), static_cast<long double>(b));
    return static_cast<double>(rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest);
}

constexpr FunctionOfTwo angle = {"atan2", &KernelBuilder::arc_tangent,
                                 [](double y, double x) { return std::atan2(y, x); }, 2.1};
constexpr FunctionOfTwo hypotenuse = {"hypot", &KernelBuilder::hypotenuse,
                                      [](double x, double y) { return std::hypot(x, y); }, 1.2};
constexpr FunctionOfTwo modulus = {"mod", &KernelBuilder::modulus, floored_rest, 0.5001};

std::vector<float> values_of(const FunctionOfTwo& function, const std::vector<float>& a,
                             const std::vector<float>& b, Form form = Form::strict) {
    return apply_to_all([&](KernelBuilder& builder, ValueId x,
                            ValueId y) { return (builder.*function.expand)(x, y); },
                        a, b, form);
}

float value_of(const FunctionOfTwo& function, float a, float b) {
    return values_of(function, {a}, {b})[0];
}

void expect_accurate(const FunctionOfTwo& function, const std::vector<float>& a,
                     const std::vector<float>& b, Form form) {
    const std::vector<float> values = values_of(function, a, b, form);
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double error = error_in_ulp(values[k], function.exact(flushed(a[k]), flushed(b[k])));
        if (error > worst) at = k;
        worst = std::max(worst, error);
    }
    EXPECT_LE(worst, function.largest_error) << function.name << "(" << a[at] << ", " << b[at]
                                             << ") = " << values[at] << ", " << name_of(form);
}

void expect_accurate(const FunctionOfTwo& function, const std::vector<float>& a,
                     const std::vector<float>& b) {
    for (const Form form : test::forms()) expect_accurate(function, a, b, form);
}

std::vector<float> symmetric_numbers(std::uint64_t seed, float scale) {
    test::RandomStream stream(seed);
    std::vector<float> x;
    for (int k = 0; k < 400000; ++k) x.push_back(stream.symmetric() * scale);
    return x;
}

std::vector<float> hostile_numbers(std::uint64_t seed) {
    test::RandomStream stream(seed);
    std::vector<float> x;
    for (int k = 0; k < 1000000; ++k) x.push_back(to_number(test::hostile_word(stream)));
    return x;
}

TEST(TwoNumbers, AnglesAndHypotenusesOfAllMagnitudes) {
    for (const FunctionOfTwo& function : {angle, hypotenuse}) {
        expect_accurate(function, symmetric_numbers(1, 1), symmetric_numbers(2, 1));
        expect_accurate(function, symmetric_numbers(3, 1), symmetric_numbers(4, 100));
        expect_accurate(function, hostile_numbers(5), hostile_numbers(6));
    }
}

TEST(TwoNumbers, AnglesOfPointsOnTheAxesAreThoseOfC) {
    const float ends[] = {0.0f, -0.0f, 1.0f, -1.0f, infinity, -infinity, 0x1p-126f, -0x1p127f};
    for (const float y : ends) {
        for (const float x : ends) {
            const float value = value_of(angle, y, x);
            EXPECT_EQ(std::signbit(value), std::signbit(std::atan2(y, x))) << y << ", " << x;
            EXPECT_NEAR(value, std::atan2(y, x), 3e-7) << y << ", " << x;
        }
        EXPECT_TRUE(std::isnan(value_of(angle, y, nan))) << y;
        EXPECT_TRUE(std::isnan(value_of(angle, nan, y))) << y;
    }
}

TEST(TwoNumbers, AnInfiniteSideHasAnInfiniteHypotenuse) {
    EXPECT_EQ(value_of(hypotenuse, infinity, nan), infinity);
    EXPECT_EQ(value_of(hypotenuse, nan, -infinity), infinity);
    EXPECT_TRUE(std::isnan(value_of(hypotenuse, nan, 1)));
    EXPECT_EQ(value_of(hypotenuse, 3, -4), 5);
    EXPECT_EQ(value_of(hypotenuse, 0, 0), 0);
    EXPECT_EQ(value_of(hypotenuse, 0x1.ep127f, 0x1.ep127f), infinity);
}

TEST(TwoNumbers, ModulusIsExactOrRoundedOnce) {
    std::vector<float> a, b;
    test::RandomStream stream(7);
    while (a.size() < 800000) {
        const float divisor = stream.symmetric() * (stream.chance(50) ? 10.0f : 1e-3f);
        const float number = stream.symmetric() * (stream.chance(50) ? 20.0f : 3000.0f);
        if (!(std::fabs(number / divisor) < 0x1p24f)) continue;
        a.push_back(number);
        b.push_back(divisor);
        a.push_back(divisor * static_cast<float>(stream.below(1000)));  // Whole quotients.
        b.push_back(divisor);
    }
    for (const Form form : test::forms()) {
        const std::vector<float> values = values_of(modulus, a, b, form);
        for (std::size_t k = 0; k < a.size(); ++k) {
            const double exact = floored_rest(a[k], b[k]);
            ASSERT_EQ(values[k], static_cast<float>(exact)) << a[k] << " mod " << b[k];
        }
    }
}

TEST(TwoNumbers, ModulusHasTheSignOfTheDivisor) {
    EXPECT_EQ(value_of(modulus, 7, 3), 1);
    EXPECT_EQ(value_of(modulus, -7, 3), 2);
    EXPECT_EQ(value_of(modulus, 7, -3), -2);
    EXPECT_EQ(value_of(modulus, -7, -3), -1);
    EXPECT_EQ(value_of(modulus, -6, 3), 0);
    EXPECT_EQ(value_of(modulus, 5.5f, 1), 0.5f);
    EXPECT_EQ(value_of(modulus, 5, infinity), 5);
    EXPECT_EQ(value_of(modulus, -5, infinity), infinity);
    EXPECT_EQ(value_of(modulus, 0, infinity), 0);
    EXPECT_EQ(value_of(modulus, 16777215.0f, 2), 1);
    for (const float x : {infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(value_of(modulus, x, 3))) << x;
    }
    EXPECT_TRUE(std::isnan(value_of(modulus, 3, 0)));
    EXPECT_TRUE(std::isnan(value_of(modulus, 3, nan)));
    EXPECT_TRUE(std::isnan(value_of(modulus, 0x1p24f, 1))) << "the quotient has no last digit";
}

float smooth(float low, float high, float x) {
    return apply_to_all([&](KernelBuilder& builder, ValueId a,
                            ValueId b) { return builder.smooth_step(a, b, builder.number(x)); },
                        std::vector{low}, std::vector{high})[0];
}

TEST(TwoNumbers, SmoothStepRisesBetweenItsEnds) {
    EXPECT_EQ(smooth(1, 3, 0), 0);
    EXPECT_EQ(smooth(1, 3, 1), 0);
    EXPECT_EQ(smooth(1, 3, 1.5f), 0.15625f);
    EXPECT_EQ(smooth(1, 3, 2), 0.5f);
    EXPECT_EQ(smooth(1, 3, 3), 1);
    EXPECT_EQ(smooth(1, 3, infinity), 1);
    EXPECT_EQ(smooth(3, 1, 1.5f), 1 - 0.15625f) << "a fall";
    EXPECT_EQ(smooth(2, 2, 1), 0);
    EXPECT_EQ(smooth(2, 2, 3), 1);
    EXPECT_TRUE(std::isnan(smooth(1, 3, nan)));
}

// Rounding to whole numbers, for every 4099th word, compared with C.
TEST(WholeNumbers, AreThoseOfC) {
    std::vector<float> x;
    for (std::uint64_t word = 0; word < 0x100000000ULL; word += 4099) {
        x.push_back(to_number(static_cast<std::uint32_t>(word)));
    }
    test::RandomStream stream(9);
    for (int k = 0; k < 200000; ++k) x.push_back(stream.symmetric() * 20.0f);
    for (int k = -40; k <= 40; ++k) x.push_back(static_cast<float>(k) * 0.5f);
    struct Case {
        const char* name;
        ValueId (KernelBuilder::*expand)(ValueId);
        double (*exact)(double);
    };
    const Case cases[] = {
        {"round", &KernelBuilder::round_to_even, [](double a) { return std::nearbyint(a); }},
        {"floor", &KernelBuilder::round_down, [](double a) { return std::floor(a); }},
        {"ceil", &KernelBuilder::round_up, [](double a) { return std::ceil(a); }},
        {"sign", &KernelBuilder::sign_of, [](double a) { return a > 0   ? 1.0
                                                                : a < 0 ? -1.0
                                                                        : a; }}};
    for (const Case& one : cases) {
        const std::vector<float> values = apply_to_all(
            [&](KernelBuilder& builder, ValueId a, ValueId) { return (builder.*one.expand)(a); }, x,
            x);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const auto exact = static_cast<float>(one.exact(flushed(x[k])));
            ASSERT_TRUE(to_bits(values[k]) == to_bits(exact) ||
                        (std::isnan(values[k]) && std::isnan(exact)))
                << one.name << "(" << x[k] << ") = " << values[k];
        }
    }
}

}  // namespace
}  // namespace cascade
