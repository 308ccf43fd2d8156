// x^y, compared with the C library in double precision.
#include "tests/support/not_finite.h"
#include "tests/support/random_stream.h"
#include "tests/unit/ir/number_function.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::apply_to_all;
using test::error_in_ulp;
using test::flushed;
using test::Form;
using test::infinity;
using test::nan;
constexpr double largest_error = 1.2;  // In ulp, as stated in ir/elementary.cpp.

std::vector<float> powers(const std::vector<float>& x, const std::vector<float>& y,
                          Form form = Form::strict) {
    return apply_to_all([](KernelBuilder& builder, ValueId a,
                           ValueId b) { return builder.power(a, b); },
                        x, y, form);
}

float power(float x, float y) { return powers({x}, {y})[0]; }

void expect_accurate(const std::vector<float>& x, const std::vector<float>& y, Form form) {
    const std::vector<float> values = powers(x, y, form);
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double exact = std::pow(flushed(x[k]), flushed(y[k]));
        ASSERT_LE(error_in_ulp(values[k], exact), largest_error)
            << x[k] << " ^ " << y[k] << " = " << values[k] << ", not " << exact << ", "
            << name_of(form);
    }
}

void expect_accurate(const std::vector<float>& x, const std::vector<float>& y) {
    for (const Form form : test::forms()) expect_accurate(x, y, form);
}

/// Compares x^y for random arguments from `draw(stream)`.
template <typename Draw>
void expect_accurate_for(std::uint64_t seed, const Draw& draw) {
    test::RandomStream stream(seed);
    std::vector<float> x, y;
    for (int k = 0; k < 300000; ++k) {
        const auto [a, b] = draw(stream);
        x.push_back(a);
        y.push_back(b);
    }
    expect_accurate(x, y);
}

struct Arguments {
    float x, y;
};

TEST(Power, AccurateForOrdinaryNumbers) {
    expect_accurate_for(1, [](test::RandomStream& stream) {
        return Arguments{std::exp2(stream.symmetric() * 4.0f), stream.symmetric() * 5.0f};
    });
}

TEST(Power, AccurateUpToTheLargestResults) {
    expect_accurate_for(2, [](test::RandomStream& stream) {
        const float x = std::exp2(stream.symmetric() * 126.0f);
        return Arguments{x, stream.symmetric() * 130.0f / std::log2(x)};
    });
}

TEST(Power, AccurateBesideOne) {
    expect_accurate_for(3, [](test::RandomStream& stream) {
        return Arguments{1.0f + stream.symmetric() * 0.01f, stream.symmetric() * 9000.0f};
    });
}

TEST(Power, WholeExponentsOfNegativeNumbers) {
    expect_accurate_for(4, [](test::RandomStream& stream) {
        return Arguments{stream.symmetric() * 100.0f, std::round(stream.symmetric() * 30.0f)};
    });
}

TEST(Power, AnyWords) {
    expect_accurate_for(5, [](test::RandomStream& stream) {
        return Arguments{to_number(test::hostile_word(stream)),
                         to_number(test::hostile_word(stream))};
    });
    expect_accurate_for(6, [](test::RandomStream& stream) {
        return Arguments{to_number(static_cast<std::uint32_t>(stream.next())),
                         to_number(static_cast<std::uint32_t>(stream.next()))};
    });
}

TEST(Power, ZeroAndOne) {
    EXPECT_EQ(power(0, 0), 1);
    EXPECT_EQ(power(nan, 0), 1);
    EXPECT_EQ(power(nan, to_number(1)), 1) << "a denormal exponent is zero";
    EXPECT_EQ(power(1, nan), 1);
    EXPECT_EQ(to_bits(power(0, 2.5f)), 0u);
    EXPECT_EQ(power(0, -2.5f), infinity);
    EXPECT_EQ(to_bits(power(-0.0f, 3)), 0x80000000u);
    EXPECT_EQ(power(-0.0f, -3), -infinity);
    EXPECT_EQ(to_bits(power(-0.0f, 2)), 0u);
}

TEST(Power, NanStays) {
    EXPECT_TRUE(std::isnan(power(nan, 2.5f)));
    EXPECT_TRUE(std::isnan(power(2, nan)));
    EXPECT_TRUE(std::isnan(power(2, to_number(0x7f800001))));
    EXPECT_TRUE(std::isnan(power(-2, nan)));
    EXPECT_TRUE(std::isnan(power(0, nan)));
    EXPECT_TRUE(std::isnan(power(-2, 2.5f)));
}

TEST(Power, SignsAndLargeExponents) {
    EXPECT_EQ(power(-2, 3), -8);
    EXPECT_EQ(power(-2, 4), 16);
    EXPECT_EQ(power(-1, 0x1.fffffep23f), -1) << "the largest odd number";
    EXPECT_EQ(power(-1, 8388607.5f - 0.5f), -1);
    EXPECT_EQ(power(-1, 0x1p24f), 1);
    EXPECT_TRUE(std::isnan(power(-1, 4194303.5f)));
    EXPECT_EQ(power(-1, infinity), 1);
    EXPECT_EQ(power(-infinity, 3), -infinity);
    EXPECT_EQ(power(-infinity, 0.5f), infinity);
    EXPECT_EQ(to_bits(power(-infinity, -3)), 0x80000000u);
    EXPECT_EQ(power(0x1.fffffep-1f, infinity), 0);
    EXPECT_EQ(power(0x1.000002p0f, infinity), infinity);
    EXPECT_EQ(power(0x1.000002p0f, 3e38f), infinity);
    EXPECT_EQ(power(0x1.fffffep-1f, -3e38f), infinity);
}

TEST(Power, ExactPowersOfTwo) {
    for (int n = -126; n <= 127; ++n) {
        EXPECT_EQ(power(2, static_cast<float>(n)), std::ldexp(1.0f, n)) << n;
    }
    EXPECT_EQ(power(4, 0.5f), 2);
    EXPECT_EQ(power(16, -0.25f), 0.5f);
}

// Powers with whole exponents are products. The error of a product of n factors is at most n/2 ulp
// of the factors' sizes.
TEST(Power, WholeConstantExponentsMultiply) {
    test::RandomStream stream(9);
    std::vector<float> x;
    for (int k = 0; k < 2000; ++k) x.push_back(stream.symmetric() * 2.0f);
    for (int n = -64; n <= 64; ++n) {
        const std::vector<float> values = apply_to_all(
            [&](KernelBuilder& builder, ValueId a, ValueId) {
                return builder.power(a, builder.number(static_cast<float>(n)));
            },
            x, x);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double exact = std::pow(static_cast<double>(x[k]), n);
            if (std::fabs(exact) < 0x1p-126 || std::fabs(exact) > 0x1p126) continue;
            ASSERT_LE(error_in_ulp(values[k], exact), 1 + std::abs(n)) << x[k] << " ^ " << n;
        }
    }
}

}  // namespace
}  // namespace cascade
