// The environment of arithmetic: its effect, and that the previous environment is restored.
#include "core/floating_point.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>

namespace cascade {
namespace {

constexpr float smallest_normal = std::numeric_limits<float>::min();
constexpr float denormal = smallest_normal / 4;

// volatile, so that the compiler does not compute the product itself.
float product(float a, float b) {
    const volatile float x = a;
    const volatile float y = b;
    return x * y;
}

TEST(FlushDenormals, ResultsAreFlushedToZeroOfTheirSign) {
    EXPECT_NE(product(smallest_normal, 0.5f), 0.0f);
    const FlushDenormals environment;
    EXPECT_EQ(product(smallest_normal, 0.5f), 0.0f);
    EXPECT_FALSE(std::signbit(product(smallest_normal, 0.5f)));
    EXPECT_TRUE(std::signbit(product(smallest_normal, -0.5f)));
}

TEST(FlushDenormals, OperandsAreReadAsZero) {
    EXPECT_GT(product(denormal, 0x1p100f), 0.0f);
    const FlushDenormals environment;
    EXPECT_EQ(product(denormal, 0x1p100f), 0.0f);
    const volatile float tiny = denormal;
    EXPECT_TRUE(tiny == 0.0f);
}

TEST(FlushDenormals, RoundsToNearestEvenWhateverWasSet) {
    const int before = std::fegetround();
    std::fesetround(FE_UPWARD);
    {
        const FlushDenormals environment;
        EXPECT_EQ(product(1.0f + 0x1p-12f, 1.0f + 0x1p-12f), 1.0f + 0x1p-11f);
    }
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
    std::fesetround(before);
}

TEST(FlushDenormals, Nests) {
    {
        const FlushDenormals outer;
        { const FlushDenormals inner; }
        EXPECT_EQ(product(smallest_normal, 0.5f), 0.0f);
    }
    EXPECT_NE(product(smallest_normal, 0.5f), 0.0f);
}

}  // namespace
}  // namespace cascade
