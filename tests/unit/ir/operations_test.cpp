// Every operation with special values: for single words, in the loops of the interpreter with every
// combination of scalar operands, and folded.
#include "core/floating_point.h"
#include "core/plane.h"
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "tests/support/not_finite.h"
#include "tests/support/random_stream.h"
#include "tests/unit/ir/operation_oracle.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace cascade {
namespace {

using test::nan;

using test::oracle;
using test::same_word;

const std::vector<Op>& operations() {
    static const std::vector<Op> all = [] {
        std::vector<Op> list;
        for (int k = 0; k < op_count; ++k) {
            if (static_cast<Op>(k) >= Op::add) list.push_back(static_cast<Op>(k));
        }
        return list;
    }();
    return all;
}

bool is_shift(Op op) { return op == Op::bits_shift_left || op == Op::bits_shift_right; }

struct Words {
    std::uint32_t a, b, c;
};

/// The word of a whole number of −252 … 252.
std::uint32_t whole_power(test::RandomStream& stream) {
    return to_bits(static_cast<float>(stream.below(505)) - 252.0f);
}

Words hostile_words(test::RandomStream& stream, Op op) {
    Words words{test::hostile_word(stream), test::hostile_word(stream), test::hostile_word(stream)};
    if (stream.chance(10)) words.b = words.a;
    if (is_shift(op)) words.b = stream.below(32);
    if (op == Op::scale_by_power) words.b = whole_power(stream);
    // c is minus the rounded product, so that only the product's rounding error remains.
    if (op == Op::multiply_add && stream.chance(30)) {
        words.c = oracle(Op::multiply, words.a, words.b, 0) ^ 0x80000000u;
    }
    return words;
}

std::string say(Op op, const Words& words) {
    return fmt::format("{} 0x{:08x} 0x{:08x} 0x{:08x}", info(op).name, words.a, words.b, words.c);
}

TEST(Operations, EvaluateIsWhatTheTableSays) {
    test::RandomStream stream(1);
    for (const Op op : operations()) {
        for (int trial = 0; trial < 20000; ++trial) {
            const Words words = hostile_words(stream, op);
            std::uint32_t value;
            {
                const FlushDenormals environment;
                value = evaluate(op, words.a, words.b, words.c);
            }
            const std::uint32_t expected = oracle(op, words.a, words.b, words.c);
            ASSERT_TRUE(same_word(value, expected))
                << say(op, words) << fmt::format(": 0x{:08x}, not 0x{:08x}", value, expected);
        }
    }
}

TEST(Operations, FoldingIsWhatTheTableSays) {
    test::RandomStream stream(2);
    for (const Op op : operations()) {
        for (int trial = 0; trial < 2000; ++trial) {
            const Words words = hostile_words(stream, op);
            KernelBuilder builder;
            const ValueId a = builder.word(words.a);
            const ValueId b = builder.word(words.b);
            const ValueId c = builder.word(words.c);
            const int arity = info(op).arity;
            const ValueId value = arity == 1   ? builder.apply(op, a)
                                  : arity == 2 ? builder.apply(op, a, b)
                                               : builder.apply(op, a, b, c);
            ASSERT_TRUE(builder.is_constant(value)) << say(op, words);
            const std::uint32_t expected = oracle(op, words.a, words.b, words.c);
            ASSERT_TRUE(same_word(builder[value].slot(), expected)) << say(op, words);
        }
    }
}

/// Operands of one operation on a row of cells. Operands in `scalars` are the same in all cells.
struct Row {
    // More than a block, and not a whole number of vectors.
    static constexpr std::int64_t cells = 300;
    std::vector<Field> fields;
    std::vector<float> uniforms;

    Row(test::RandomStream& stream, Op op, const PlaneLayout& layout) {
        for (int k = 0; k < 3; ++k) {
            fields.emplace_back(layout);
            uniforms.push_back(to_number(test::hostile_word(stream)));
        }
        if (op == Op::scale_by_power) uniforms[1] = to_number(whole_power(stream));
        for (std::int64_t i = 0; i < cells; ++i) {
            const Words words = hostile_words(stream, op);
            fields[0].at(i, 0) = to_number(words.a);
            fields[1].at(i, 0) = to_number(words.b);
            fields[2].at(i, 0) = to_number(words.c);
        }
    }
    std::uint32_t word(unsigned operand, unsigned scalars, std::int64_t i) const {
        return to_bits((scalars >> operand & 1) != 0 ? uniforms[operand]
                                                     : fields[operand].at(i, 0));
    }
};

CellKernel kernel_of(Op op, unsigned scalars, std::uint32_t shift) {
    CellKernel kernel;
    kernel.field_names = {"a", "b", "c"};
    kernel.uniform_names = {"a", "b", "c"};
    Instruction instruction{op, {}, 0};
    for (unsigned k = 0; static_cast<int>(k) < info(op).arity; ++k) {
        const bool is_amount = is_shift(op) && k == 1;
        const bool is_scalar = (scalars >> k & 1) != 0;
        const Op source = is_amount ? Op::constant : is_scalar ? Op::uniform : Op::field;
        instruction.operands[k] = kernel.code.next();
        kernel.code.push_back({source, {}, is_amount ? shift : k});
    }
    kernel.results = {kernel.code.next()};
    kernel.result_names = {"r"};
    kernel.code.push_back(instruction);
    return kernel;
}

TEST(Operations, LoopsAreWhatTheTableSays) {
    const Grid grid{Row::cells, 1, Boundary::periodic};
    const PlaneLayout layout(grid);
    const auto backend = make_interpreter();
    test::RandomStream stream(3);
    for (const Op op : operations()) {
        for (unsigned scalars = 0; scalars < 1u << info(op).arity; ++scalars) {
            const std::uint32_t shift = stream.below(32);
            const CellKernel kernel = kernel_of(op, scalars, shift);
            ASSERT_EQ(verify(kernel), "");
            const Row row(stream, op, layout);
            Field out(layout);
            const float* fields[] = {row.fields[0].origin(), row.fields[1].origin(),
                                     row.fields[2].origin()};
            float* results[] = {out.origin()};
            {
                const FlushDenormals environment;
                const KernelPointer compiled = *backend->compile(kernel, Stencil::row);
                compiled->run({fields, {}, row.uniforms, results, layout}, {0, 1});
            }
            for (std::int64_t i = 0; i < Row::cells; ++i) {
                Words words{row.word(0, scalars, i), row.word(1, scalars, i),
                            row.word(2, scalars, i)};
                if (is_shift(op)) words.b = shift;
                ASSERT_TRUE(same_word(to_bits(out.at(i, 0)), oracle(op, words.a, words.b, words.c)))
                    << say(op, words) << ", scalar operands " << scalars;
            }
        }
    }
}

// A few of the rules, stated explicitly.
TEST(Operations, SpecialValues) {
    const FlushDenormals environment;
    const auto value = [](Op op, float a, float b = 0, float c = 0) {
        return to_number(evaluate(op, to_bits(a), to_bits(b), to_bits(c)));
    };
    const float denormal = to_number(1);
    EXPECT_EQ(value(Op::logical_not, nan), 0) << "NaN is true";
    EXPECT_EQ(value(Op::logical_not, denormal), 1) << "a denormal number is zero";
    EXPECT_EQ(value(Op::logical_not, -0.0f), 1);
    EXPECT_EQ(value(Op::not_equal, nan, nan), 1);
    EXPECT_EQ(value(Op::equal, nan, nan), 0);
    EXPECT_EQ(value(Op::equal, 0.0f, -0.0f), 1);
    EXPECT_EQ(value(Op::equal, denormal, 0), 1);
    EXPECT_EQ(value(Op::less, -denormal, denormal), 0);
    EXPECT_EQ(value(Op::select, nan, 1, 2), 1);
    EXPECT_EQ(value(Op::select, denormal, 1, 2), 2);
    EXPECT_EQ(to_bits(value(Op::select, 1, denormal, 2)), 1u) << "words are passed as they are";
    EXPECT_EQ(to_bits(value(Op::negate, denormal)), 0x80000001u);
    EXPECT_EQ(to_bits(value(Op::absolute, -denormal)), 1u);
    EXPECT_EQ(to_bits(value(Op::add, -denormal, -0.0f)), 0x80000000u);
    EXPECT_TRUE(std::isnan(value(Op::square_root, -1)));
    EXPECT_EQ(to_bits(value(Op::square_root, -0.0f)), 0x80000000u);
    EXPECT_EQ(to_bits(value(Op::square_root, -denormal)), 0x80000000u);
    EXPECT_EQ(value(Op::round_to_even, 2.5f), 2);
    EXPECT_EQ(to_bits(value(Op::round_to_even, -0.5f)), 0x80000000u);
    EXPECT_EQ(to_bits(value(Op::round_to_even, -denormal)), 0x80000000u);
    EXPECT_EQ(value(Op::round_to_even, -INFINITY), -INFINITY);
    EXPECT_EQ(value(Op::scale_by_power, 0x1.8p-126f, 252), 0x1.8p126f);
    EXPECT_EQ(value(Op::scale_by_power, 0x1p126f, -252), 0x1p-126f);
    EXPECT_EQ(to_bits(value(Op::scale_by_power, -0x1.8p0f, -127)), 0x80000000u);
    EXPECT_EQ(value(Op::scale_by_power, 1, 128), INFINITY);
    EXPECT_EQ(value(Op::multiply_add, 0x1.000002p0f, 0x1.000002p0f, -0x1.000004p0f), 0x1p-46f);
    EXPECT_EQ(to_bits(value(Op::multiply_add, denormal, 2, denormal)), 0u);
    EXPECT_EQ(to_bits(value(Op::multiply_add, 0x1p-70f, -0x1p-70f, 0)), 0x80000000u);
    EXPECT_EQ(value(Op::multiply_add, 0x1p100f, 0x1p100f, -std::numeric_limits<float>::infinity()),
              -std::numeric_limits<float>::infinity());
    EXPECT_EQ(value(Op::bits_to_number, to_number(0xffffffff)), -1.0f);
    EXPECT_EQ(value(Op::bits_to_number, to_number(0x7fffffff)), 0x1p31f);
}

}  // namespace
}  // namespace cascade
