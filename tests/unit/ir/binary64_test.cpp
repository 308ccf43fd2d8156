// Functions in binary64, compared with the C library in long double, whose significands have 64
// bits.
#include "tests/support/random_stream.h"
#include "tests/unit/ir/number_function.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>

namespace cascade::binary64 {
namespace {

using test::apply_to_all;
using test::error_in_ulp;
using test::flushed;
using test::Form;

static_assert(std::numeric_limits<long double>::digits >= 64, "exact values have digits to spare");

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest errors, in ulp, are those of spec/numerics.md.
struct Function {
    const char* name;
    ValueId (KernelBuilder::*expand)(ValueId);
    long double (*exact)(long double);
    double largest_error;
    double largest_argument = infinity;
};

constexpr Function exp_function = {"exp", &KernelBuilder::exponential,
                                   [](long double x) { return std::exp(x); }, 1.0};
constexpr Function log_function = {"log", &KernelBuilder::logarithm,
                                   [](long double x) { return std::log(x); }, 0.9};
constexpr Function sin_function = {"sin", &KernelBuilder::sine,
                                   [](long double x) { return std::sin(x); }, 0.9, 0x1p27};
constexpr Function cos_function = {"cos", &KernelBuilder::cosine,
                                   [](long double x) { return std::cos(x); }, 0.9, 0x1p27};
constexpr Function tan_function = {"tan", &KernelBuilder::tangent,
                                   [](long double x) { return std::tan(x); }, 2.2, 0x1p27};
constexpr Function asin_function = {"asin", &KernelBuilder::arc_sine,
                                    [](long double x) { return std::asin(x); }, 1.1};
constexpr Function acos_function = {"acos", &KernelBuilder::arc_cosine,
                                    [](long double x) { return std::acos(x); }, 1.1};
constexpr Function sinh_function = {"sinh", &KernelBuilder::hyperbolic_sine,
                                    [](long double x) { return std::sinh(x); }, 2.0};
constexpr Function cosh_function = {"cosh", &KernelBuilder::hyperbolic_cosine,
                                    [](long double x) { return std::cosh(x); }, 2.0};
constexpr Function tanh_function = {"tanh", &KernelBuilder::hyperbolic_tangent,
                                    [](long double x) { return std::tanh(x); }, 1.5};
constexpr Function cbrt_function = {"cbrt", &KernelBuilder::cube_root,
                                    [](long double x) { return std::cbrt(x); }, 0.6};
constexpr Function functions[] = {exp_function,  log_function,  sin_function,  cos_function,
                                  tan_function,  asin_function, acos_function, sinh_function,
                                  cosh_function, tanh_function, cbrt_function};

std::vector<double> values_of(const Function& function, const std::vector<double>& x,
                              Form form = Form::strict) {
    return apply_to_all([&](KernelBuilder& builder, ValueId a,
                            ValueId) { return (builder.*function.expand)(a); },
                        x, x, form);
}

double value_of(const Function& function, double x) { return values_of(function, {x})[0]; }

double worst_error(const Function& function, const std::vector<double>& x, Form form) {
    const std::vector<double> values = values_of(function, x, form);
    double worst = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (std::fabs(x[k]) > function.largest_argument) continue;
        const double error =
            error_in_ulp(values[k], function.exact(static_cast<long double>(flushed(x[k]))));
        worst = std::max(worst, error);
        EXPECT_LE(error, function.largest_error)
            << function.name << "(" << x[k] << ") = " << values[k] << ", " << name_of(form);
        if (error > function.largest_error) break;
    }
    return worst;
}

void expect_accurate(const Function& function, const std::vector<double>& x) {
    for (const Form form : test::forms()) worst_error(function, x, form);
}

// Words at equal distances cover all exponents, both signs, NaN and infinities.
TEST(Binary64, FunctionsAreAccurateForAllMagnitudes) {
    std::vector<double> x;
    constexpr std::uint64_t stride = 0x0000200000001357;
    for (std::uint64_t word = 0; word < ~std::uint64_t{0} - stride; word += stride) {
        x.push_back(std::bit_cast<double>(word));
    }
    for (const Function& function : functions) expect_accurate(function, x);
}

double fine_number(test::RandomStream& stream) {
    return static_cast<double>(stream.next() >> 11) * 0x1p-52 - 1;
}

TEST(Binary64, FunctionsAreAccurateWhereTheyAreUsed) {
    test::RandomStream stream(5);
    std::vector<double> x;
    for (int k = 0; k < 200000; ++k) x.push_back(fine_number(stream));
    for (int k = 0; k < 200000; ++k) x.push_back(fine_number(stream) * 20);
    for (int k = 0; k < 200000; ++k) x.push_back(1 + fine_number(stream) * 0.01);
    for (int k = 0; k < 100000; ++k) x.push_back(fine_number(stream) * 700);
    for (const Function& function : functions) {
        for (const Form form : test::forms()) {
            const double worst = worst_error(function, x, form);
            EXPECT_GE(worst, 0.49) << function.name << ": arguments that test nothing";
            std::printf("%s: %.3f ulp, %s\n", function.name, worst, name_of(form));
        }
    }
}

// The numbers closest to multiples of π/2 need the most digits of π.
TEST(Binary64, AnglesBesideMultiplesOfAQuarterTurn) {
    test::RandomStream stream(6);
    std::vector<double> x;
    const long double quarter_turn = 1.570796326794896619231321691639751442L;
    for (int k = 0; k < 40000; ++k) {
        const auto n = k < 20000 ? k + 1 : static_cast<int>(stream.below(85000000));
        double near = static_cast<double>(n * quarter_turn);
        near = std::nextafter(near, -infinity);
        for (int each = 0; each < 3; ++each, near = std::nextafter(near, infinity)) {
            x.push_back(near);
            x.push_back(-near);
        }
    }
    for (const Function& function : {sin_function, cos_function, tan_function}) {
        expect_accurate(function, x);
    }
}

TEST(Binary64, LargeAnglesHaveASmallAbsoluteError) {
    test::RandomStream stream(7);
    std::vector<double> x;
    for (int k = 0; k < 100000; ++k) x.push_back(fine_number(stream) * 0x1p53);
    const std::vector<double> sines = values_of(sin_function, x);
    for (std::size_t k = 0; k < x.size(); ++k) {
        const long double exact = std::sin(static_cast<long double>(x[k]));
        ASSERT_LE(std::fabs(static_cast<double>(sines[k] - exact)),
                  std::fabs(static_cast<double>(exact)) * 0x1p-52 + 0x1p-75)
            << x[k];
    }
    for (const double beyond : {0x1p53 + 2, 1e300, infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(value_of(sin_function, beyond))) << beyond;
        EXPECT_TRUE(std::isnan(value_of(tan_function, beyond))) << beyond;
    }
}

TEST(Binary64, FunctionsAtTheirEnds) {
    // ln of the largest number is 709.78271289338397…, of the smallest normal one −708.39641853226…
    EXPECT_LT(value_of(exp_function, 709.782712893383), infinity);
    EXPECT_EQ(value_of(exp_function, 709.782712893385), infinity);
    EXPECT_GT(value_of(exp_function, -708.396418532264), 0);
    EXPECT_EQ(value_of(exp_function, -708.396418532265), 0);
    EXPECT_EQ(value_of(exp_function, infinity), infinity);
    EXPECT_EQ(value_of(exp_function, -infinity), 0);
    EXPECT_EQ(value_of(exp_function, 0x1p-1030), 1);
    EXPECT_EQ(value_of(log_function, 0x1p-1030), -infinity) << "a denormal is zero";
    EXPECT_EQ(value_of(log_function, -0.0), -infinity);
    EXPECT_EQ(value_of(log_function, infinity), infinity);
    EXPECT_TRUE(std::isnan(value_of(log_function, -0x1p-1022)));
    EXPECT_LT(value_of(cosh_function, 710.47586007394), infinity);
    EXPECT_EQ(value_of(cosh_function, 710.475860073945), infinity);
    EXPECT_EQ(value_of(tanh_function, -infinity), -1);
    EXPECT_EQ(value_of(acos_function, 1), 0);
    EXPECT_EQ(value_of(acos_function, -1), 0x1.921fb54442d18p+1);
    EXPECT_TRUE(std::isnan(value_of(asin_function, 1 + 0x1p-52)));
    for (const Function& function :
         {sin_function, tan_function, asin_function, sinh_function, tanh_function, cbrt_function}) {
        EXPECT_TRUE(std::signbit(value_of(function, -0.0))) << function.name;
        EXPECT_EQ(value_of(function, -0x1p-1030), 0) << function.name;
    }
    for (int k = -300; k <= 300; ++k) {
        EXPECT_EQ(value_of(cbrt_function, 1.0 * k * k * k), k);
    }
}

/// Pairs of arguments.
struct Pairs {
    std::vector<double> x, y;
};

Pairs pairs(std::uint64_t seed, const std::function<double(test::RandomStream&)>& first,
            const std::function<double(test::RandomStream&)>& second) {
    test::RandomStream stream(seed);
    Pairs made;
    for (int k = 0; k < 200000; ++k) {
        made.x.push_back(first(stream));
        made.y.push_back(second(stream));
    }
    return made;
}

double hostile(test::RandomStream& stream) {
    return std::bit_cast<double>(test::hostile_long_word(stream));
}

void expect_accurate(const char* name, ValueId (KernelBuilder::*expand)(ValueId, ValueId),
                     long double (*exact)(long double, long double), double largest_error,
                     const Pairs& arguments, Form form) {
    const std::vector<double> values = apply_to_all(
        [&](KernelBuilder& builder, ValueId a, ValueId b) { return (builder.*expand)(a, b); },
        arguments.x, arguments.y, form);
    double worst = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double x = flushed(arguments.x[k]), y = flushed(arguments.y[k]);
        const double error = error_in_ulp(values[k], exact(static_cast<long double>(x),
                                                           static_cast<long double>(y)));
        ASSERT_LE(error, largest_error)
            << name << "(" << x << ", " << y << ") = " << values[k] << ", " << name_of(form);
        worst = std::max(worst, error);
    }
    std::printf("%s: %.3f ulp, %s\n", name, worst, name_of(form));
}

void expect_accurate(const char* name, ValueId (KernelBuilder::*expand)(ValueId, ValueId),
                     long double (*exact)(long double, long double), double largest_error,
                     const Pairs& arguments) {
    for (const Form form : test::forms()) {
        expect_accurate(name, expand, exact, largest_error, arguments, form);
    }
}

TEST(Binary64, FunctionsOfTwoNumbers) {
    const auto angle = [](long double y, long double x) { return std::atan2(y, x); };
    const auto length = [](long double x, long double y) { return std::hypot(x, y); };
    const auto power = [](long double x, long double y) { return std::pow(x, y); };
    for (const Pairs& each :
         {pairs(1, fine_number, fine_number),
          pairs(2, fine_number, [](auto& stream) { return 100 * fine_number(stream); }),
          pairs(3, hostile, hostile)}) {
        expect_accurate("atan2", &KernelBuilder::arc_tangent, angle, 2.1, each);
        expect_accurate("hypot", &KernelBuilder::hypotenuse, length, 1.2, each);
        expect_accurate("pow", &KernelBuilder::power, power, 1.5, each);
    }
    const auto positive = [](auto& stream) { return std::exp2(4 * fine_number(stream)); };
    expect_accurate("pow", &KernelBuilder::power, power, 1.5,
                    pairs(4, positive, [](auto& stream) { return 5 * fine_number(stream); }));
    // Results close to both ends of the range.
    expect_accurate("pow", &KernelBuilder::power, power, 1.5,
                    pairs(5, positive, [](auto& stream) { return 250 * fine_number(stream); }));
    expect_accurate("pow", &KernelBuilder::power, power, 1.5,
                    pairs(
                        6, [](auto& stream) { return 1 + 0x1p-20 * fine_number(stream); },
                        [](auto& stream) { return 0x1p29 * fine_number(stream); }));
}

TEST(Binary64, ModulusIsExactOrRoundedOnce) {
    const auto rest = [](long double a, long double b) {
        const long double left = std::fmod(a, b);
        if (left == 0) return 0.0L;
        return (left < 0) != (b < 0) ? left + b : left;
    };
    const auto large = [](auto& stream) { return std::ldexp(fine_number(stream), 40); };
    const auto about_one = [](auto& stream) { return 1 + fine_number(stream) / 2; };
    for (const Pairs& each :
         {pairs(1, fine_number, about_one), pairs(2, large, about_one),
          pairs(3, large, [](auto& stream) { return 1.0 + stream.below(99); })}) {
        expect_accurate("mod", &KernelBuilder::modulus, rest, 0.5001, each);
    }
}

TEST(Binary64, RoundingIsThatOfC) {
    test::RandomStream stream(9);
    std::vector<double> x = {0.5,          -0.5,       1.5,      2.5,      -0.0,
                             0x1p51 + 0.5, 0x1p52 + 1, infinity, -infinity};
    for (int k = 0; k < 100000; ++k) x.push_back(std::ldexp(fine_number(stream), k % 60));
    const auto apply = [&](ValueId (KernelBuilder::*expand)(ValueId)) {
        return apply_to_all(
            [&](KernelBuilder& builder, ValueId a, ValueId) { return (builder.*expand)(a); }, x, x);
    };
    const std::vector<double> nearest = apply(&KernelBuilder::round_to_even);
    const std::vector<double> below = apply(&KernelBuilder::round_down);
    const std::vector<double> above = apply(&KernelBuilder::round_up);
    for (std::size_t k = 0; k < x.size(); ++k) {
        ASSERT_EQ(nearest[k], std::nearbyint(x[k])) << x[k];
        ASSERT_EQ(below[k], std::floor(x[k])) << x[k];
        ASSERT_EQ(above[k], std::ceil(x[k])) << x[k];
    }
}

}  // namespace
}  // namespace cascade::binary64
