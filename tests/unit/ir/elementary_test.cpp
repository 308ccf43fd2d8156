// Functions of one number, compared with the C library in double precision, whose error is 2^−29 of
// the tested error.
#include "tests/support/not_finite.h"
#include "tests/support/random_stream.h"
#include "tests/unit/ir/number_function.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using test::apply_to_all;
using test::error_in_ulp;
using test::flushed;
using test::Form;
using test::infinity;
using test::nan;

struct Function {
    const char* name;
    ValueId (KernelBuilder::*expand)(ValueId);
    double (*exact)(double);
    double largest_error;  ///< In ulp, as stated in ir/elementary.cpp.
    float largest_argument;
};

// Functions with names for messages. The C library's functions are overloaded.
constexpr Function exp_function = {"exp", &KernelBuilder::exponential,
                                   [](double x) { return std::exp(x); }, 1.0, infinity};
constexpr Function log_function = {"log", &KernelBuilder::logarithm,
                                   [](double x) { return std::log(x); }, 0.9, infinity};
constexpr Function sin_function = {"sin", &KernelBuilder::sine,
                                   [](double x) { return std::sin(x); }, 0.8, 8192};
constexpr Function cos_function = {"cos", &KernelBuilder::cosine,
                                   [](double x) { return std::cos(x); }, 0.8, 8192};
constexpr Function tanh_function = {"tanh", &KernelBuilder::hyperbolic_tangent,
                                    [](double x) { return std::tanh(x); }, 1.5, infinity};
constexpr Function tan_function = {"tan", &KernelBuilder::tangent,
                                   [](double x) { return std::tan(x); }, 2.2, 8192};
constexpr Function asin_function = {"asin", &KernelBuilder::arc_sine,
                                    [](double x) { return std::asin(x); }, 1.1, infinity};
constexpr Function acos_function = {"acos", &KernelBuilder::arc_cosine,
                                    [](double x) { return std::acos(x); }, 1.1, infinity};
constexpr Function sinh_function = {"sinh", &KernelBuilder::hyperbolic_sine,
                                    [](double x) { return std::sinh(x); }, 2.0, infinity};
constexpr Function cosh_function = {"cosh", &KernelBuilder::hyperbolic_cosine,
                                    [](double x) { return std::cosh(x); }, 2.0, infinity};
constexpr Function cbrt_function = {"cbrt", &KernelBuilder::cube_root,
                                    [](double x) { return std::cbrt(x); }, 0.6, infinity};
constexpr Function functions[] = {exp_function,  log_function,  sin_function,  cos_function,
                                  tanh_function, tan_function,  asin_function, acos_function,
                                  sinh_function, cosh_function, cbrt_function};

std::vector<float> values_of(const Function& function, const std::vector<float>& x,
                             Form form = Form::strict) {
    return apply_to_all([&](KernelBuilder& builder, ValueId a,
                            ValueId) { return (builder.*function.expand)(a); },
                        x, x, form);
}

float value_of(const Function& function, float x) { return values_of(function, {x})[0]; }

void expect_accurate(const Function& function, const std::vector<float>& x, Form form) {
    const std::vector<float> values = values_of(function, x, form);
    double worst = 0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (std::fabs(x[k]) > function.largest_argument) continue;
        const double error = error_in_ulp(values[k], function.exact(flushed(x[k])));
        if (error > worst) at = k;
        worst = std::max(worst, error);
    }
    EXPECT_LE(worst, function.largest_error)
        << function.name << "(" << x[at] << ") = " << values[at] << ", " << name_of(form);
    EXPECT_GE(worst, 0.49) << function.name << ": arguments that test nothing";
}

void expect_accurate(const Function& function, const std::vector<float>& x) {
    for (const Form form : test::forms()) expect_accurate(function, x, form);
}

// Every 4099th of all words: these cover all exponents, both signs, NaN and infinities.
TEST(Elementary, AccurateForAllMagnitudes) {
    std::vector<float> x;
    for (std::uint64_t word = 0; word < 0x100000000ULL; word += 4099) {
        x.push_back(to_number(static_cast<std::uint32_t>(word)));
    }
    for (const Function& function : functions) expect_accurate(function, x);
}

TEST(Elementary, AccurateWhereTheyAreUsed) {
    test::RandomStream stream(5);
    std::vector<float> x;
    for (int k = 0; k < 400000; ++k) x.push_back(stream.symmetric() * 10.0f);
    for (int k = 0; k < 400000; ++k) x.push_back(1.0f + stream.symmetric() * 0.01f);
    for (const Function& function : functions) expect_accurate(function, x);
}

// The numbers closest to multiples of π/2 need the most digits of π.
TEST(Elementary, AccurateBesideMultiplesOfAQuarterTurn) {
    std::vector<float> x;
    const double quarter_turn = 1.57079632679489661923;
    for (int n = 1; n <= 5215; ++n) {
        float near = static_cast<float>(n * quarter_turn);
        for (int k = 0; k < 2; ++k) near = std::nextafter(near, -infinity);
        for (int k = 0; k < 5; ++k, near = std::nextafter(near, infinity)) {
            x.push_back(near);
            x.push_back(-near);
        }
    }
    expect_accurate(sin_function, x);
    expect_accurate(cos_function, x);
    expect_accurate(tan_function, x);
}

TEST(Elementary, LargeAnglesHaveASmallAbsoluteError) {
    test::RandomStream stream(6);
    std::vector<float> x;
    for (int k = 0; k < 300000; ++k) x.push_back(stream.symmetric() * 0x1p24f);
    const std::vector<float> sines = values_of(sin_function, x);
    const std::vector<float> cosines = values_of(cos_function, x);
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double angle = x[k];
        ASSERT_NEAR(sines[k], std::sin(angle), 0x1p-23 * std::fabs(std::sin(angle)) + 0x1p-33)
            << angle;
        ASSERT_NEAR(cosines[k], std::cos(angle), 0x1p-23 * std::fabs(std::cos(angle)) + 0x1p-33)
            << angle;
    }
}

TEST(Elementary, AnglesWithoutMeaningAreNan) {
    for (const float x : {0x1.000002p24f, 1e30f, infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(value_of(sin_function, x))) << x;
        EXPECT_TRUE(std::isnan(value_of(cos_function, x))) << x;
    }
    EXPECT_NEAR(value_of(sin_function, 0x1p24f), std::sin(0x1p24), 1e-7);
}

TEST(Elementary, ExponentialAtItsEnds) {
    EXPECT_EQ(value_of(exp_function, 0), 1);
    EXPECT_EQ(value_of(exp_function, to_number(0x80000001)), 1);
    EXPECT_EQ(value_of(exp_function, infinity), infinity);
    EXPECT_EQ(to_bits(value_of(exp_function, -infinity)), 0u);
    EXPECT_TRUE(std::isnan(value_of(exp_function, nan)));
    EXPECT_TRUE(std::isnan(value_of(exp_function, to_number(0xff800001))));
    // ln of the largest number is 88.72283905…, of the smallest normal one −87.33654475…
    EXPECT_LT(value_of(exp_function, 88.7228f), infinity);
    EXPECT_EQ(value_of(exp_function, 88.7229f), infinity);
    EXPECT_GT(value_of(exp_function, -87.3365f), 0);
    EXPECT_EQ(to_bits(value_of(exp_function, -87.3366f)), 0u);
}

TEST(Elementary, LogarithmAtItsEnds) {
    EXPECT_EQ(to_bits(value_of(log_function, 1)), 0u);
    EXPECT_EQ(value_of(log_function, 0), -infinity);
    EXPECT_EQ(value_of(log_function, -0.0f), -infinity);
    EXPECT_EQ(value_of(log_function, to_number(0x007fffff)), -infinity) << "a denormal is zero";
    EXPECT_EQ(value_of(log_function, to_number(0x807fffff)), -infinity);
    EXPECT_EQ(value_of(log_function, infinity), infinity);
    EXPECT_TRUE(std::isnan(value_of(log_function, -0x1p-126f)));
    EXPECT_TRUE(std::isnan(value_of(log_function, -infinity)));
    EXPECT_TRUE(std::isnan(value_of(log_function, nan)));
}

TEST(Elementary, OddFunctionsKeepTheSignOfZero) {
    for (const Function& function :
         {sin_function, tanh_function, tan_function, asin_function, sinh_function, cbrt_function}) {
        EXPECT_EQ(to_bits(value_of(function, 0.0f)), 0u) << function.name;
        EXPECT_EQ(to_bits(value_of(function, -0.0f)), 0x80000000u) << function.name;
        EXPECT_EQ(to_bits(value_of(function, to_number(0x80000001))), 0x80000000u) << function.name;
    }
}

TEST(Elementary, SymmetriesAreExact) {
    test::RandomStream stream(7);
    for (int k = 0; k < 1000; ++k) {
        const float x = stream.symmetric() * 100.0f;
        EXPECT_EQ(value_of(sin_function, -x), -value_of(sin_function, x));
        EXPECT_EQ(value_of(cos_function, -x), value_of(cos_function, x));
        EXPECT_EQ(value_of(tanh_function, -x), -value_of(tanh_function, x));
        EXPECT_EQ(value_of(tan_function, -x), -value_of(tan_function, x));
        EXPECT_EQ(value_of(sinh_function, -x), -value_of(sinh_function, x));
        EXPECT_EQ(value_of(cosh_function, -x), value_of(cosh_function, x));
        EXPECT_EQ(value_of(cbrt_function, -x), -value_of(cbrt_function, x));
    }
}

TEST(Elementary, TangentReachesOne) {
    EXPECT_EQ(value_of(tanh_function, infinity), 1);
    EXPECT_EQ(value_of(tanh_function, -infinity), -1);
    EXPECT_EQ(value_of(tanh_function, 50), 1);
    EXPECT_TRUE(std::isnan(value_of(tanh_function, nan)));
}

TEST(Elementary, HyperbolicFunctionsAtTheirEnds) {
    // cosh reaches the largest number at 89.41598628…
    for (const Function& function : {sinh_function, cosh_function}) {
        EXPECT_LT(value_of(function, 89.4159f), infinity) << function.name;
        EXPECT_EQ(value_of(function, 89.4161f), infinity) << function.name;
        EXPECT_EQ(value_of(function, infinity), infinity) << function.name;
        EXPECT_TRUE(std::isnan(value_of(function, nan))) << function.name;
    }
    EXPECT_EQ(value_of(sinh_function, -infinity), -infinity);
    EXPECT_EQ(value_of(cosh_function, -infinity), infinity);
    EXPECT_EQ(value_of(cosh_function, 0), 1);
}

TEST(Elementary, InverseFunctionsAtTheirEnds) {
    EXPECT_EQ(value_of(asin_function, 1), 0x1.921fb6p+0f);
    EXPECT_EQ(value_of(asin_function, -1), -0x1.921fb6p+0f);
    EXPECT_EQ(to_bits(value_of(acos_function, 1)), 0u);
    EXPECT_EQ(value_of(acos_function, -1), 0x1.921fb6p+1f);
    EXPECT_EQ(value_of(acos_function, 0), 0x1.921fb6p+0f);
    for (const Function& function : {asin_function, acos_function}) {
        for (const float x : {1.0000001f, -1.0000001f, infinity, -infinity, nan}) {
            EXPECT_TRUE(std::isnan(value_of(function, x))) << function.name << " " << x;
        }
    }
}

TEST(Elementary, CubesHaveExactRoots) {
    for (int k = -200; k <= 200; ++k) {
        const auto root = static_cast<float>(k);
        EXPECT_EQ(value_of(cbrt_function, root * root * root), root);
    }
    EXPECT_EQ(value_of(cbrt_function, infinity), infinity);
    EXPECT_EQ(value_of(cbrt_function, -infinity), -infinity);
    EXPECT_TRUE(std::isnan(value_of(cbrt_function, nan)));
}

TEST(Elementary, ConstantsFoldToTheSameBits) {
    test::RandomStream stream(8);
    for (const Function& function : functions) {
        for (int k = 0; k < 500; ++k) {
            const float x = to_number(test::hostile_word(stream));
            KernelBuilder builder;
            const ValueId folded = (builder.*function.expand)(builder.word(to_bits(x)));
            ASSERT_TRUE(builder.is_constant(folded));
            const auto value = static_cast<float>(builder.constant(folded));
            const float run = value_of(function, x);
            ASSERT_TRUE(to_bits(value) == to_bits(run) || (std::isnan(value) && std::isnan(run)))
                << function.name << "(" << x << "): " << value << " and " << run;
        }
    }
}

}  // namespace
}  // namespace cascade
