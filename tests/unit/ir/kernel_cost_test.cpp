// Costs of kernels, compared with costs counted by hand.
#include "ir/builder.h"
#include "ir/kernel_cost.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

/// new = a + d · lap(a), where d is a uniform or a plane.
CellKernel diffusion(bool plane, Precision precision = Precision::single) {
    KernelBuilder builder(precision);
    const FieldSlot a = builder.field_slot("a");
    const ValueId d =
        plane ? builder.field(builder.field_slot("d")) : builder.uniform(builder.uniform_slot("d"));
    builder.result("a", builder.add(builder.field(a), builder.multiply(d, builder.laplacian(a))));
    return std::move(builder).finish();
}

TEST(KernelCost, DiffusionOnAPlane) {
    const KernelCost cost = cost_of(diffusion(false), Stencil::plane, 0);
    EXPECT_EQ(cost.operations, 7);  // N + S + E + W − 4 c: five; d · …: one; a + …: one.
    EXPECT_EQ(cost.divisions, 0);
    EXPECT_EQ(cost.loads, 5);  // The cell and four around it.
    EXPECT_EQ(cost.stores, 1);
    EXPECT_EQ(cost.load_bytes, 20);
    EXPECT_EQ(cost.store_bytes, 4);
}

TEST(KernelCost, AMultiplyAddIsOneOperationWithItsSign) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a")),
                  b = builder.field(builder.field_slot("b"));
    const ValueId sign = builder.apply(Op::negate, b);
    const ValueId sum = builder.apply(Op::multiply_add, a, sign, b);
    builder.result("r", sum);
    CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(cost_of(kernel, Stencil::plane, 0).operations, 1);
    kernel.results = {ValueId(2)};  // The negated value is written: one more operation.
    EXPECT_EQ(cost_of(kernel, Stencil::plane, 0).operations, 2);
}

TEST(KernelCost, OtherStencilsHaveOtherSums) {
    EXPECT_EQ(cost_of(diffusion(false), Stencil::row, 0).operations, 5);
    EXPECT_EQ(cost_of(diffusion(false), Stencil::row, 0).loads, 3);
    EXPECT_EQ(cost_of(diffusion(false), Stencil::column, 0).loads, 3);
    EXPECT_EQ(cost_of(diffusion(false), Stencil::volume, 0).operations, 9);
    EXPECT_EQ(cost_of(diffusion(false), Stencil::volume, 0).loads, 7);
}

TEST(KernelCost, APlaneIsALoadMore) {
    const KernelCost cost = cost_of(diffusion(true, Precision::binary64), Stencil::plane, 0);
    EXPECT_EQ(cost.operations, 7);
    EXPECT_EQ(cost.loads, 6);
    EXPECT_EQ(cost.load_bytes, 48);
    EXPECT_EQ(cost.store_bytes, 8);
}

TEST(KernelCost, LinksCostAPlaceAWeightAndAValueEach) {
    // Three operations for each link, a product and a sum. Loads: the cell and three words for each
    // link.
    const KernelCost cost = cost_of(diffusion(false), Stencil::linked, 6);
    EXPECT_EQ(cost.operations, 20);
    EXPECT_EQ(cost.loads, 19);
    EXPECT_EQ(cost.load_bytes, 76);
    EXPECT_EQ(cost.link_bytes, 48);
    // In binary64 indices have the same size.
    EXPECT_EQ(cost_of(diffusion(false, Precision::binary64), Stencil::linked, 6).load_bytes,
              8 + 6 * (4 + 8 + 8));
}

TEST(KernelCost, LaplaciansShareTheirLinks) {
    KernelBuilder builder;
    const ValueId a = builder.laplacian(builder.field_slot("a"));
    const ValueId b = builder.laplacian(builder.field_slot("b"));
    builder.result("r", builder.add(a, b));
    const KernelCost cost = cost_of(std::move(builder).finish(), Stencil::linked, 5);
    EXPECT_EQ(cost.loads, 2 + 5 * (1 + 1 + 2));
    EXPECT_EQ(cost.operations, 2 * 15 + 1);
}

TEST(KernelCost, SumsOfOtherKindsOverLinks) {
    KernelBuilder builder;
    const FieldSlot a = builder.field_slot("a"), b = builder.field_slot("b");
    const ValueId flow = builder.link_flow({b, a});
    const ValueId squares = builder.over_links(Op::link_squares, a);
    const ValueId gradient = builder.over_links(Op::gradient_y, a);
    builder.result("r", builder.add(flow, builder.add(squares, gradient)));
    const KernelCost cost = cost_of(std::move(builder).finish(), Stencil::linked, 4);
    EXPECT_EQ(cost.operations, 4 * (5 + 4 + 3) + 2);
    // Indices, two tables of weights, two gathered fields, and both fields in the cell.
    EXPECT_EQ(cost.loads, 4 * (1 + 2 + 2) + 2);
}

TEST(KernelCost, WhatIsTheSameInAllCellsIsNotCounted) {
    KernelBuilder builder;
    const ValueId p = builder.uniform(builder.uniform_slot("p"));
    const ValueId q = builder.divide(builder.multiply(p, p), builder.number(3));
    const ValueId a = builder.field(builder.field_slot("a"));
    builder.result("r", builder.multiply(a, q));
    const KernelCost cost = cost_of(std::move(builder).finish(), Stencil::plane, 0);
    EXPECT_EQ(cost.operations, 1);
    EXPECT_EQ(cost.divisions, 0);
}

TEST(KernelCost, DivisionsAndRootsAreToldApart) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    builder.result("r",
                   builder.divide(a, builder.apply(Op::square_root, builder.apply(Op::negate, b))));
    const KernelCost cost = cost_of(std::move(builder).finish(), Stencil::plane, 0);
    EXPECT_EQ(cost.operations, 3);
    EXPECT_EQ(cost.divisions, 2);
}

TEST(KernelCost, MasksAreBytes) {
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId frozen = builder.mask(builder.mask_slot("frozen"));
    builder.result("r", builder.select(frozen, a, builder.apply(Op::negate, a)));
    const KernelCost cost = cost_of(std::move(builder).finish(), Stencil::plane, 0);
    EXPECT_EQ(cost.operations, 2);
    EXPECT_EQ(cost.loads, 2);
    EXPECT_EQ(cost.load_bytes, 5);
}

TEST(KernelCost, NeighboursAlongAnAxisOfOneCellAreTheCell) {
    KernelBuilder builder;
    const FieldSlot a = builder.field_slot("a");
    const ValueId east = builder.neighbour(a, 1, 0), south = builder.neighbour(a, 0, 1);
    builder.result("r", builder.add(builder.add(east, south), builder.laplacian(a)));
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(cost_of(kernel, Stencil::plane, 0).loads, 5);
    EXPECT_EQ(cost_of(kernel, Stencil::row, 0).loads, 3);
}

}  // namespace
}  // namespace cascade
