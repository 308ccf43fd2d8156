// Kernels after contraction, as text.
#include "ir/builder.h"
#include "ir/contraction.h"

#include <gtest/gtest.h>

#include <functional>

namespace cascade {
namespace {

/// Fields and uniforms for formulas.
struct Names {
    KernelBuilder& builder;
    ValueId field(const char* name) const { return builder.field(builder.field_slot(name)); }
    ValueId number(const char* name) const { return builder.uniform(builder.uniform_slot(name)); }
    ValueId product(ValueId a, ValueId b) const { return builder.multiply(a, b); }
    ValueId sum(ValueId a, ValueId b) const { return builder.add(a, b); }
    ValueId difference(ValueId a, ValueId b) const { return builder.subtract(a, b); }
};

CellKernel kernel_of(const std::function<ValueId(const Names&)>& formula) {
    KernelBuilder builder;
    const Names names{builder};
    for (const char* name : {"a", "b", "c"}) names.field(name);
    for (const char* name : {"d", "e"}) names.number(name);
    builder.result("r", formula(names));
    return std::move(builder).finish();
}

std::string text(const std::function<ValueId(const Names&)>& formula) {
    const CellKernel kernel = contracted(kernel_of(formula));
    EXPECT_EQ(verify(kernel), "");
    return print(kernel);
}

/// Returns whether contraction leaves a formula unchanged.
bool stays(const std::function<ValueId(const Names&)>& formula) {
    return text(formula) == print(kernel_of(formula));
}

TEST(Contraction, FusesAProductWithTheSumBehindIt) {
    EXPECT_EQ(text([](const Names& n) {
                  return n.sum(n.field("a"), n.product(n.number("d"), n.field("b")));
              }),
              "%0 = field a\n%1 = field b\n%2 = uniform d\n%3 = multiply_add %2, %1, %0\n"
              "result r = %3\n");
}

TEST(Contraction, TurnsTheSignOfWhatVaries) {
    EXPECT_EQ(text([](const Names& n) {
                  return n.difference(n.field("a"), n.product(n.field("b"), n.number("d")));
              }),
              "%0 = field a\n%1 = field b\n%2 = uniform d\n%3 = negate %1\n"
              "%4 = multiply_add %2, %3, %0\nresult r = %4\n");
    EXPECT_EQ(text([](const Names& n) {
                  return n.difference(n.product(n.field("a"), n.field("b")), n.field("c"));
              }),
              "%0 = field a\n%1 = field b\n%2 = field c\n%3 = negate %2\n"
              "%4 = multiply_add %0, %1, %3\nresult r = %4\n");
}

TEST(Contraction, OfTwoProductsTheSecondIsFused) {
    EXPECT_EQ(text([](const Names& n) {
                  const ValueId first = n.product(n.field("a"), n.field("b"));
                  return n.sum(first, n.product(n.field("c"), n.field("c")));
              }),
              "%0 = field a\n%1 = field b\n%2 = field c\n%3 = multiply %0, %1\n"
              "%4 = multiply_add %2, %2, %3\nresult r = %4\n");
}

TEST(Contraction, OfTwoProductsTheOneWithACoefficientIsFused) {
    EXPECT_EQ(text([](const Names& n) {
                  const ValueId first = n.product(n.field("a"), n.number("d"));
                  return n.sum(first, n.product(n.field("b"), n.field("c")));
              }),
              "%0 = field a\n%1 = field b\n%2 = field c\n%3 = uniform d\n%4 = multiply %1, %2\n"
              "%5 = multiply_add %3, %0, %4\nresult r = %5\n");
}

TEST(Contraction, FusesAProductWithEachSumThatReadsIt) {
    const std::string code = text([](const Names& n) {
        const ValueId shared = n.product(n.field("a"), n.field("b"));
        return n.builder.divide(n.sum(shared, n.field("c")), n.difference(n.field("c"), shared));
    });
    EXPECT_EQ(code.find(" = multiply %"), std::string::npos) << code;
    EXPECT_EQ(code.find(" = add "), std::string::npos) << code;
    EXPECT_EQ(code.find(" = subtract "), std::string::npos) << code;
}

// A product is fused with a sum even if other instructions read the product.
TEST(Contraction, FusesAProductThatIsAlsoReadOtherwise) {
    const std::string code = text([](const Names& n) {
        const ValueId shared = n.product(n.field("a"), n.field("b"));
        return n.builder.divide(n.sum(shared, n.field("c")), shared);
    });
    EXPECT_NE(code.find(" = multiply %"), std::string::npos) << code;
    EXPECT_NE(code.find(" = multiply_add "), std::string::npos) << code;
}

TEST(Contraction, LeavesTwiceAProduct) {
    EXPECT_TRUE(stays([](const Names& n) {
        const ValueId product = n.product(n.field("a"), n.field("b"));
        return n.sum(product, product);
    }));
}

TEST(Contraction, LeavesWhatIsTheSameInAllCells) {
    EXPECT_TRUE(stays([](const Names& n) {
        return n.sum(n.product(n.number("d"), n.number("e")), n.field("a"));
    }));
}

TEST(Contraction, LeavesWhatIsKept) {
    EXPECT_TRUE(stays([](const Names& n) {
        const ValueId product = n.product(n.field("a"), n.field("b"));
        n.builder.keep(product);
        return n.sum(product, n.field("c"));
    }));
    EXPECT_TRUE(stays([](const Names& n) {
        const ValueId quotient = n.builder.divide(n.field("a"), n.number("d"));
        n.builder.keep(quotient);
        return quotient;
    }));
}

TEST(Contraction, DividesByWhatIsTheSameInAllCellsOnce) {
    EXPECT_EQ(text([](const Names& n) {
                  return n.sum(n.builder.divide(n.field("a"), n.number("d")), n.field("b"));
              }),
              "%0 = field a\n%1 = field b\n%2 = uniform d\n%3 = constant 0x3f800000  # 1\n"
              "%4 = divide %3, %2\n%5 = multiply_add %4, %0, %1\nresult r = %5\n");
    EXPECT_TRUE(
        stays([](const Names& n) { return n.builder.divide(n.number("d"), n.field("a")); }));
    EXPECT_TRUE(
        stays([](const Names& n) { return n.builder.divide(n.number("d"), n.number("e")); }));
}

TEST(Contraction, KeepsSlotsNamesAndPrecision) {
    KernelBuilder builder(Precision::binary64);
    builder.field_slot("unused");
    const ValueId a = builder.field(builder.field_slot("a"));
    builder.mask_slot("m");
    builder.uniform_slot("d");
    builder.result("r", builder.add(a, builder.multiply(a, a)));
    const CellKernel kernel = std::move(builder).finish(), fast = contracted(kernel);
    EXPECT_EQ(fast.field_names, kernel.field_names);
    EXPECT_EQ(fast.mask_names, kernel.mask_names);
    EXPECT_EQ(fast.uniform_names, kernel.uniform_names);
    EXPECT_EQ(fast.result_names, kernel.result_names);
    EXPECT_EQ(fast.precision, kernel.precision);
}

}  // namespace
}  // namespace cascade
