// Kernels as data: their text, their hash, and errors that verify() finds.
#include "ir/builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using ::testing::HasSubstr;

/// new = a + speed · lap(a), but the old value where a mask is set.
CellKernel heat_kernel() {
    KernelBuilder builder;
    const FieldSlot a = builder.field_slot("a");
    const ValueId old = builder.field(a);
    const ValueId speed = builder.uniform(builder.uniform_slot("speed"));
    const ValueId flow = builder.multiply(speed, builder.laplacian(a));
    const ValueId moved = builder.add(old, builder.multiply(flow, builder.number(0.25f)));
    builder.result("a", builder.select(builder.mask(builder.mask_slot("frozen")), old, moved));
    return std::move(builder).finish();
}

TEST(Print, Golden) {
    EXPECT_EQ(print(heat_kernel()),
              "%0 = field a\n"
              "%1 = uniform speed\n"
              "%2 = laplacian a\n"
              "%3 = multiply %1, %2\n"
              "%4 = constant 0x3e800000  # 0.25\n"
              "%5 = multiply %3, %4\n"
              "%6 = add %0, %5\n"
              "%7 = mask frozen\n"
              "%8 = select %7, %0, %6\n"
              "result a = %8\n");
}

TEST(Print, Neighbours) {
    KernelBuilder builder;
    builder.field_slot("other");
    builder.result("r", builder.neighbour(builder.field_slot("a"), 1, -1, 0));
    EXPECT_EQ(print(std::move(builder).finish()),
              "%0 = neighbour a at (1, -1, 0)\nresult r = %0\n");
}

TEST(Verify, Neighbours) {
    KernelBuilder builder;
    builder.result("r", builder.neighbour(builder.field_slot("a"), 1, 1, 1));
    CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(verify(kernel), "");
    EXPECT_TRUE(kernel.reads_neighbours(FieldSlot(0)));
    kernel.code[ValueId(0)].payload = 27;
    EXPECT_THAT(verify(kernel), HasSubstr("farther"));
    kernel.code[ValueId(0)].payload = 13;
    EXPECT_THAT(verify(kernel), HasSubstr("itself"));
    kernel.code[ValueId(0)].payload = Neighbour{FieldSlot(1), 1, 0, 0}.payload();
    EXPECT_THAT(verify(kernel), HasSubstr("slot 1 of 1"));
}

TEST(ReadsNeighbours, OfLaplaciansOnly) {
    KernelBuilder builder;
    const ValueId here = builder.field(builder.field_slot("here"));
    const ValueId around = builder.laplacian(builder.field_slot("around"));
    builder.result("r", builder.add(here, around));
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_FALSE(kernel.reads_neighbours(FieldSlot(0)));
    EXPECT_TRUE(kernel.reads_neighbours(FieldSlot(1)));
}

TEST(SoleResults, OfFieldsReadForOneResultInTheCellItself) {
    KernelBuilder builder;
    const auto field = [&](const char* name) { return builder.field_slot(name); };
    const ValueId own = builder.field(field("own")), shared = builder.field(field("shared"));
    const ValueId both = builder.field(field("both"));
    builder.result("a", builder.add(builder.add(own, shared), builder.laplacian(field("both"))));
    builder.result("b", builder.add(builder.multiply(shared, shared), both));
    builder.field(field("unread"));
    const CellKernel kernel = std::move(builder).finish();
    const auto sole = sole_results(kernel);
    for (const FieldSlot slot : kernel.field_names.ids()) {
        const bool is_own = kernel.field_names[slot] == "own";
        EXPECT_EQ(sole[slot], is_own ? std::optional<std::size_t>(0) : std::nullopt)
            << kernel.field_names[slot];
    }
}

TEST(Hash, IgnoresNames) {
    CellKernel renamed = heat_kernel();
    renamed.field_names[FieldSlot(0)] = "other";
    renamed.result_names[0] = "other";
    EXPECT_EQ(hash(renamed), hash(heat_kernel()));
}

TEST(Hash, SeesEverythingThatDecidesTheCode) {
    const std::uint64_t original = hash(heat_kernel());
    for (const ValueId id : heat_kernel().code.ids()) {
        CellKernel changed = heat_kernel();
        changed.code[id].payload ^= 1;
        EXPECT_NE(hash(changed), original) << "payload of %" << id.index();
        for (int operand = 0; operand < info(changed.code[id].op).arity; ++operand) {
            changed = heat_kernel();
            ValueId& read = changed.code[id].operands[static_cast<std::size_t>(operand)];
            read = ValueId(read.index() ^ 1);
            EXPECT_NE(hash(changed), original) << "operand " << operand << " of %" << id.index();
        }
    }
    CellKernel changed = heat_kernel();
    changed.code[ValueId(6)].op = Op::subtract;
    EXPECT_NE(hash(changed), original);
    changed = heat_kernel();
    changed.results[0] = ValueId(6);
    EXPECT_NE(hash(changed), original);
    changed = heat_kernel();
    changed.results.push_back(ValueId(8));
    EXPECT_NE(hash(changed), original);
}

TEST(Verify, AcceptsWhatTheBuilderMakes) { EXPECT_EQ(verify(heat_kernel()), ""); }

TEST(Verify, AcceptsNothing) { EXPECT_EQ(verify(CellKernel{}), ""); }

TEST(Verify, OperandsComeBefore) {
    CellKernel kernel = heat_kernel();
    kernel.code[ValueId(3)].operands[0] = ValueId(3);
    EXPECT_THAT(verify(kernel), HasSubstr("%3 reads %3, which does not come before it"));
}

TEST(Verify, UnusedOperandsAreZero) {
    CellKernel kernel = heat_kernel();
    kernel.code[ValueId(3)].operands[2] = ValueId(1);
    EXPECT_THAT(verify(kernel), HasSubstr("%3 has an operand too many"));
}

TEST(Verify, SlotsExist) {
    for (const std::size_t source : {0u, 1u, 2u, 7u}) {
        CellKernel kernel = heat_kernel();
        kernel.code[ValueId(source)].payload = 1;
        EXPECT_THAT(verify(kernel), HasSubstr("names slot 1 of 1")) << "%" << source;
    }
}

TEST(Verify, NoPayloadWhereNoneIsTaken) {
    CellKernel kernel = heat_kernel();
    kernel.code[ValueId(6)].payload = 1;
    EXPECT_THAT(verify(kernel), HasSubstr("%6 has a payload but takes none"));
}

TEST(Verify, ShiftAmounts) {
    KernelBuilder builder;
    const ValueId column = builder.cell_column();
    const ValueId amount = builder.word(31);
    builder.result("r", builder.apply(Op::bits_shift_left, column, amount));
    CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(verify(kernel), "");
    kernel.code[ValueId(1)].payload = 32;
    EXPECT_THAT(verify(kernel), HasSubstr("%2 shifts by 32"));
    kernel.code[ValueId(2)].operands[1] = ValueId(0);
    EXPECT_THAT(verify(kernel), HasSubstr("%2 shifts by an amount that is not constant"));
}

TEST(Verify, ResultsExistAndHaveNames) {
    CellKernel kernel = heat_kernel();
    kernel.results[0] = ValueId(9);
    EXPECT_THAT(verify(kernel), HasSubstr("result 0 is %9, which does not exist"));
    kernel = heat_kernel();
    kernel.result_names.clear();
    EXPECT_THAT(verify(kernel), HasSubstr("1 results have 0 names"));
}

TEST(Verify, OperationsAreOfTheTable) {
    CellKernel kernel = heat_kernel();
    kernel.code[ValueId(4)].op = static_cast<Op>(op_count);
    EXPECT_THAT(verify(kernel), HasSubstr("%4 is no operation of the table"));
}

TEST(Table, NamesAndArities) {
    EXPECT_EQ(info(Op::constant).name, "constant");
    EXPECT_EQ(info(Op::constant).payload, PayloadKind::bits);
    EXPECT_EQ(info(Op::select).arity, 3);
    EXPECT_EQ(info(Op::bits_to_number).name, "bits_to_number");
    EXPECT_EQ(static_cast<int>(Op::bits_to_number) + 1, op_count);
    EXPECT_EQ(info_arity(Op::negate), 1);
}

}  // namespace
}  // namespace cascade
