// The builder: numbering, folding, composed operations, removal of unused values.
#include "ir/builder.h"

#include "core/floating_point.h"
#include "ir/interpreter.h"
#include "tests/support/not_finite.h"
#include "tests/unit/ir/operation_oracle.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::infinity;
using test::nan;

TEST(Builder, EqualInstructionsAreOneValue) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    EXPECT_EQ(builder.field(FieldSlot(0)), a);
    EXPECT_EQ(builder.add(a, b), builder.add(a, b));
    EXPECT_NE(builder.add(a, b), builder.add(b, a)) << "operands are not reordered";
    EXPECT_NE(builder.add(a, b), builder.subtract(a, b));
    EXPECT_EQ(builder.number(0.5f), builder.number(0.5f));
    EXPECT_NE(builder.number(0.0f), builder.number(-0.0f)) << "words are compared, not numbers";
    EXPECT_NE(builder.field(FieldSlot(0)), builder.laplacian(FieldSlot(0)));
}

TEST(Builder, SlotsAreMadeOnce) {
    KernelBuilder builder;
    EXPECT_EQ(builder.field_slot("a"), FieldSlot(0));
    EXPECT_EQ(builder.field_slot("b"), FieldSlot(1));
    EXPECT_EQ(builder.field_slot("a"), FieldSlot(0));
    EXPECT_EQ(builder.mask_slot("a"), MaskSlot(0));
    EXPECT_EQ(builder.uniform_slot("b"), UniformSlot(0));
}

TEST(Builder, NumbersAreCanonical) {
    KernelBuilder builder;
    EXPECT_EQ(builder[builder.number(to_number(1))].payload, 0u);
    EXPECT_EQ(builder[builder.number(to_number(0x80000001))].payload, 0x80000000u);
    EXPECT_EQ(builder[builder.number(-nan)].payload, 0x7fc00000u);
    EXPECT_EQ(builder[builder.word(1)].payload, 1u) << "words are not numbers";
}

TEST(Builder, FoldedNanDoesNotDependOnTheHost) {
    KernelBuilder builder;
    const ValueId zero = builder.number(0);
    EXPECT_EQ(builder[builder.divide(zero, zero)].payload, 0x7fc00000u);
}

TEST(Builder, FoldingFlushes) {
    KernelBuilder builder;
    const ValueId small = builder.number(0x1p-126f);
    EXPECT_EQ(builder[builder.multiply(small, builder.number(-0.5f))].payload, 0x80000000u);
}

TEST(Builder, NoIdentityThatFlushesOrLosesASign) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    EXPECT_NE(builder.multiply(a, builder.number(1)), a);
    EXPECT_NE(builder.add(a, builder.number(0)), a);
    EXPECT_NE(builder.subtract(a, builder.number(0)), a);
    EXPECT_NE(builder.divide(a, builder.number(1)), a);
    EXPECT_FALSE(builder.is_constant(builder.multiply(a, builder.number(0))));
    EXPECT_FALSE(builder.is_constant(builder.subtract(a, a)));
}

TEST(Builder, SelectIsSimplified) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    EXPECT_EQ(builder.select(a, b, b), b);
    EXPECT_EQ(builder.select(builder.number(2), a, b), a);
    EXPECT_EQ(builder.select(builder.number(nan), a, b), a);
    EXPECT_EQ(builder.select(builder.number(-0.0f), a, b), b);
    EXPECT_EQ(builder.select(builder.word(1), a, b), b) << "a denormal number is not true";
}

TEST(Builder, LogicWithAConstantIsSimplified) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId truth = builder.apply(Op::less, a, builder.number(3));
    const ValueId yes = builder.number(1);
    const ValueId no = builder.number(0);
    EXPECT_EQ(builder.apply(Op::logical_or, truth, yes), yes);
    EXPECT_EQ(builder.apply(Op::logical_or, no, truth), truth);
    EXPECT_EQ(builder.apply(Op::logical_and, truth, no), no);
    EXPECT_EQ(builder.apply(Op::logical_and, builder.number(nan), truth), truth);
    EXPECT_NE(builder.apply(Op::logical_or, a, no), a) << "a is not 1 or 0";
}

TEST(Builder, FinishDropsWhatNoResultNeeds) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    builder.multiply(a, b);
    const ValueId sum = builder.add(b, builder.number(2));
    builder.multiply(sum, a);
    builder.result("first", sum);
    builder.result("second", b);
    builder.result("third", sum);
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(print(kernel),
              "%0 = field b\n"
              "%1 = constant 0x40000000  # 2\n"
              "%2 = add %0, %1\n"
              "result first = %2\n"
              "result second = %0\n"
              "result third = %2\n");
    EXPECT_EQ(kernel.field_names.size(), 2u) << "slots are kept";
    EXPECT_EQ(verify(kernel), "");
}

// ---- Composed operations on constants: folding gives the same as running.

float folded(ValueId (KernelBuilder::*function)(ValueId, ValueId), float a, float b) {
    KernelBuilder builder;
    const ValueId value = (builder.*function)(builder.word(to_bits(a)), builder.word(to_bits(b)));
    EXPECT_TRUE(builder.is_constant(value));
    return static_cast<float>(builder.constant(value));
}

TEST(Minimum, PassesNanOn) {
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::minimum, nan, 1)));
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::minimum, 1, nan)));
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::maximum, nan, 1)));
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::maximum, 1, nan)));
}

TEST(Minimum, OfNumbers) {
    EXPECT_EQ(folded(&KernelBuilder::minimum, 1, 2), 1);
    EXPECT_EQ(folded(&KernelBuilder::minimum, 2, -infinity), -infinity);
    EXPECT_EQ(folded(&KernelBuilder::maximum, 1, 2), 2);
    EXPECT_EQ(folded(&KernelBuilder::maximum, 2, infinity), infinity);
}

TEST(Minimum, OfEqualNumbersIsTheSecond) {
    EXPECT_EQ(to_bits(folded(&KernelBuilder::minimum, 0.0f, -0.0f)), 0x80000000u);
    EXPECT_EQ(to_bits(folded(&KernelBuilder::minimum, -0.0f, 0.0f)), 0u);
    EXPECT_EQ(to_bits(folded(&KernelBuilder::maximum, 0.0f, -0.0f)), 0x80000000u);
    EXPECT_EQ(to_bits(folded(&KernelBuilder::maximum, -0.0f, 0.0f)), 0u);
}

TEST(Clamp, LetsNanStand) {
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::clamp_below, nan, 0)));
    EXPECT_TRUE(std::isnan(folded(&KernelBuilder::clamp_above, nan, 0)));
    EXPECT_EQ(folded(&KernelBuilder::clamp_below, 1, nan), 1) << "a bound that is NaN is none";
}

TEST(Clamp, OfNumbers) {
    EXPECT_EQ(folded(&KernelBuilder::clamp_below, -1, 0), 0);
    EXPECT_EQ(folded(&KernelBuilder::clamp_below, 1, 0), 1);
    EXPECT_EQ(to_bits(folded(&KernelBuilder::clamp_below, -0.0f, 0)), 0x80000000u);
    EXPECT_EQ(folded(&KernelBuilder::clamp_above, 1, 0), 0);
    EXPECT_EQ(folded(&KernelBuilder::clamp_above, -1, 0), -1);
}

// ---- Powers with whole exponents are products.

std::string text_of_power(float exponent) {
    KernelBuilder builder;
    const ValueId x = builder.field(builder.field_slot("x"));
    builder.result("r", builder.power(x, builder.number(exponent)));
    return print(std::move(builder).finish());
}

TEST(WholePower, LowestBitsFirst) {
    EXPECT_EQ(text_of_power(3),
              "%0 = field x\n%1 = multiply %0, %0\n%2 = multiply %0, %1\n"
              "result r = %2\n");
    EXPECT_EQ(text_of_power(7),
              "%0 = field x\n%1 = multiply %0, %0\n%2 = multiply %0, %1\n"
              "%3 = multiply %1, %1\n%4 = multiply %2, %3\nresult r = %4\n");
    EXPECT_EQ(text_of_power(4),
              "%0 = field x\n%1 = multiply %0, %0\n%2 = multiply %1, %1\n"
              "result r = %2\n");
    EXPECT_EQ(text_of_power(1), "%0 = field x\nresult r = %0\n");
    EXPECT_EQ(text_of_power(0), "%0 = constant 0x3f800000  # 1\nresult r = %0\n");
    EXPECT_EQ(text_of_power(-2),
              "%0 = field x\n%1 = multiply %0, %0\n"
              "%2 = constant 0x3f800000  # 1\n%3 = divide %2, %1\n"
              "result r = %3\n");
}

TEST(WholePower, UpTo64) {
    EXPECT_EQ(text_of_power(64).find("constant"), std::string::npos);
    EXPECT_NE(text_of_power(65).find("constant"), std::string::npos);
    EXPECT_NE(text_of_power(0.5f).find("constant"), std::string::npos);
}

}  // namespace
}  // namespace cascade
