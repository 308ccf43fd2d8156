// The interpreter: inputs and outputs, rows and blocks, and random kernels compared with an
// evaluation of one cell after another.
#include "ir/interpreter.h"

#include "core/floating_point.h"
#include "ir/builder.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_kernels.h"
#include "tests/support/random_stream.h"
#include "tests/unit/ir/operation_oracle.h"

#include <array>
#include <gtest/gtest.h>

#include <memory>

namespace cascade {
namespace {

using test::oracle;

/// A kernel that computes one cell after another with the tests' own definitions of operations.
class CellByCell : public Backend {
public:
    std::string_view name() const override { return "cell by cell"; }
    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        return std::make_shared<const Compiled>(kernel, stencil);
    }
    KernelPointer find(const CellKernel& kernel, Stencil stencil) override {
        return *compile(kernel, stencil);
    }

private:
    class Compiled : public Kernel {
    public:
        Compiled(CellKernel kernel, Stencil stencil)
            : kernel_(std::move(kernel)), stencil_(stencil) {}

        void run(const KernelArguments& arguments, const Patch& cells) const override {
            Words words(kernel_.code.size());
            const ColumnRange columns = cells.columns.within(arguments.layout.width);
            for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
                for (std::int64_t i = columns.begin; i < columns.end; ++i) {
                    for (const ValueId id : words.ids()) {
                        words[id] = word(arguments, i, row, kernel_.code[id], words);
                    }
                    const std::int64_t at = arguments.layout.row_start(row) + i;
                    for (std::size_t k = 0; k < kernel_.results.size(); ++k) {
                        arguments.results[k][at] = to_number(words[kernel_.results[k]]);
                    }
                }
            }
        }

    private:
        using Words = IdVector<ValueId, std::uint32_t>;

        std::uint32_t word(const KernelArguments& arguments, std::int64_t i, std::int64_t row,
                           const Instruction& instruction, const Words& words) const {
            const std::uint32_t slot = instruction.slot();
            const PlaneLayout& layout = arguments.layout;
            const std::int64_t at = layout.row_start(row) + i;
            switch (instruction.op) {
                case Op::constant: return slot;
                case Op::field: return to_bits(arguments.fields[slot][at]);
                case Op::laplacian: return laplacian(arguments.fields[slot] + at, layout);
                case Op::neighbour: {
                    const Neighbour beside = Neighbour::of(slot);
                    return to_bits(
                        arguments.fields[beside.slot.index()]
                                        [at + step(layout, beside.dx, beside.dy, beside.dz)]);
                }
                case Op::mask: return test::truth(arguments.masks[slot][at] != 0);
                case Op::uniform: return to_bits(arguments.uniforms[slot]);
                case Op::cell_column: return static_cast<std::uint32_t>(i);
                case Op::cell_row: return static_cast<std::uint32_t>(row % layout.height);
                case Op::cell_slice: return static_cast<std::uint32_t>(row / layout.height);
                default: break;
            }
            const auto [a, b, c] = instruction.operands;
            return oracle(instruction.op, words[a], words[b], words[c]);
        }

        /// The offset of a neighbour in elements. Along an axis of one cell, the offset is 0.
        std::int64_t step(const PlaneLayout& layout, int dx, int dy, int dz) const {
            return (stencil_.x ? dx : 0) + (stencil_.y ? dy * layout.stride : 0) +
                   (stencil_.z ? dz * layout.slice_stride : 0);
        }

        std::uint32_t laplacian(const float* cell, const PlaneLayout& layout) const {
            std::vector<std::int64_t> neighbours;
            if (stencil_.y) neighbours.insert(neighbours.end(), {-layout.stride, layout.stride});
            if (stencil_.x) neighbours.insert(neighbours.end(), {1, -1});
            if (stencil_.z) {
                neighbours.insert(neighbours.end(), {-layout.slice_stride, layout.slice_stride});
            }
            std::uint32_t sum = to_bits(cell[neighbours[0]]);
            for (std::size_t k = 1; k < neighbours.size(); ++k) {
                sum = oracle(Op::add, sum, to_bits(cell[neighbours[k]]), 0);
            }
            const auto count = static_cast<float>(neighbours.size());
            if (count < 6) {  // One rounding: the multiple is exact in double precision.
                return test::write_number(test::read_number(sum) -
                                          double{count} * test::read_number(to_bits(cell[0])));
            }
            return oracle(Op::subtract, sum,
                          oracle(Op::multiply, to_bits(count), to_bits(cell[0]), 0), 0);
        }

        CellKernel kernel_;
        Stencil stencil_;
    };
};

TEST(Interpreter, RandomKernelsAgainstCellByCell) {
    const auto interpreter = make_interpreter();
    CellByCell reference;
    test::OperationCounts counts;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const CellKernel kernel = test::random_kernel(seed);
        ASSERT_EQ(verify(kernel), "") << "seed " << seed;
        counts.add(kernel);
        const Grid grid = test::random_grid(seed, seed % 20 == 0 ? 600 : 67, 5, 3);
        const auto expected = test::run_kernel(reference, kernel, grid, seed);
        const auto actual = test::run_kernel(*interpreter, kernel, grid, seed);
        ASSERT_EQ(test::same_bits(expected, actual), "") << "seed " << seed << "\n"
                                                         << print(kernel);
        ASSERT_EQ(test::stray_writes(actual, {0, PlaneLayout(grid).row_count()}), "")
            << "seed " << seed;
    }
    EXPECT_EQ(counts.missing(), "") << counts.report();
}

TEST(Interpreter, ComputesTheCellsItIsGiven) {
    const auto interpreter = make_interpreter();
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const CellKernel kernel = test::random_kernel(seed);
        const Grid grid{37, 7, Boundary::periodic};
        const test::HostileInputs inputs(kernel, grid, seed);
        const KernelPointer compiled = *interpreter->compile(kernel, grid.stencil());
        const std::vector<Field> whole = inputs.run(*compiled);
        const Patch cells{{2, 5}, {16, 37}};
        const std::vector<Field> part = inputs.run(*compiled, cells);
        ASSERT_EQ(test::stray_writes(part, cells), "");
        for (std::size_t k = 0; k < part.size(); ++k) {
            for (std::int64_t j = cells.rows.begin; j < cells.rows.end; ++j) {
                for (std::int64_t i = cells.columns.begin; i < cells.columns.end; ++i) {
                    ASSERT_TRUE(
                        test::same_word(to_bits(part[k].at(i, j)), to_bits(whole[k].at(i, j))));
                }
            }
        }
    }
}

/// Runs `kernel` on one field of a grid, its halo filled.
std::vector<Field> run_on(const CellKernel& kernel, Field& field, const Grid& grid) {
    fill_halo(field.origin(), field.layout(), grid.boundary);
    std::vector<Field> results;
    std::vector<float*> targets;
    for (std::size_t k = 0; k < kernel.results.size(); ++k) {
        results.emplace_back(field.layout());
        targets.push_back(results.back().origin());
    }
    const float* fields[] = {field.origin()};
    const float uniforms[] = {2.5f};
    const FlushDenormals environment;
    const KernelPointer compiled = *make_interpreter()->compile(kernel, grid.stencil());
    compiled->run({fields,
                   {},
                   std::span(uniforms).first(kernel.uniform_names.size()),
                   targets,
                   field.layout()},
                  {0, field.layout().row_count()});
    return results;
}

// 2^24 + 1 + 1 is 2^24 if added from the left, and 2^24 + 2 if the small numbers are added first,
// so the result shows the order.
TEST(Laplacian, HasTheOrderOfTheSpecification) {
    KernelBuilder builder;
    builder.result("r", builder.laplacian(builder.field_slot("a")));
    const CellKernel kernel = std::move(builder).finish();
    const Grid grid{3, 3, Boundary::periodic};
    Field field{PlaneLayout(grid)};
    const auto value = [&](float north, float south, float east, float west) {
        field.at(1, 0) = north;
        field.at(1, 2) = south;
        field.at(2, 1) = east;
        field.at(0, 1) = west;
        return run_on(kernel, field, grid)[0].at(1, 1);
    };
    EXPECT_EQ(value(0x1p24f, 1, 1, 0), 0x1p24f);
    EXPECT_EQ(value(1, 1, 0x1p24f, 0), 0x1p24f + 2);
    EXPECT_EQ(value(1, 0, 1, 0x1p24f), 0x1p24f + 2);
    EXPECT_EQ(value(1, 0x1p24f, 0, 1), 0x1p24f);
    EXPECT_EQ(value(0, 1, 0x1p24f, 1), 0x1p24f);
    EXPECT_EQ(value(1, 1, 1, 1), 4);
    field.at(1, 1) = 3;
    EXPECT_EQ(value(1, 1, 1, 1), -8);
}

// 4c is not rounded separately: it may exceed the largest number if the result does not.
TEST(Laplacian, OfHugeNumbersOverflowsAtItsEndOnly) {
    KernelBuilder builder;
    builder.result("r", builder.laplacian(builder.field_slot("a")));
    const CellKernel kernel = std::move(builder).finish();
    const auto value = [&](const Grid& grid, float around, float own) {
        Field field{PlaneLayout(grid)};
        const std::int64_t i = grid.width / 2, j = grid.height / 2;
        for (std::int64_t row = -1; row <= grid.height; ++row) {
            for (std::int64_t k = -1; k <= grid.width; ++k) field.at(k, row) = around;
        }
        field.at(i, j) = own;
        return run_on(kernel, field, grid)[0].at(i, j);
    };
    const Grid plane{3, 3, Boundary::periodic}, row{3, 1, Boundary::periodic};
    EXPECT_EQ(value(plane, 0x1p125f, 0x1p126f), -0x1p127f);
    EXPECT_EQ(value(plane, -0x1p125f, -0x1p126f), 0x1p127f);
    EXPECT_EQ(value(plane, 0x1p125f, 0x1p127f), -INFINITY);
    EXPECT_EQ(value(plane, 1, 0x1p126f), -INFINITY);
    EXPECT_EQ(value(plane, 0x1p-126f, 0x1.8p125f), -0x1.8p127f);
    EXPECT_EQ(value(row, 0x1p126f, 0x1p127f), -0x1p127f);
    EXPECT_EQ(value(row, 0x1p126f, 0x1.8p127f), -INFINITY);
}

TEST(Laplacian, OnLines) {
    KernelBuilder builder;
    builder.result("r", builder.laplacian(builder.field_slot("a")));
    const CellKernel kernel = std::move(builder).finish();
    for (const Grid& grid : {Grid{5, 1, Boundary::no_flux}, Grid{1, 5, Boundary::no_flux}}) {
        Field field{PlaneLayout(grid)};
        const auto cell = [&](Field& of, std::int64_t k) -> float& {
            return grid.height == 1 ? of.at(k, 0) : of.at(0, k);
        };
        for (std::int64_t k = 0; k < 5; ++k) cell(field, k) = static_cast<float>(k * k);
        std::vector<Field> results = run_on(kernel, field, grid);
        EXPECT_EQ(cell(results[0], 0), 1) << "mirror: 1 + 0 − 2 · 0";
        for (std::int64_t k = 1; k < 4; ++k) EXPECT_EQ(cell(results[0], k), 2);
        EXPECT_EQ(cell(results[0], 4), -7) << "mirror: 16 + 9 − 2 · 16";
    }
}

// ((((N + S) + E) + W) + U) + D − 6c: the rounding error shows the order.
TEST(Laplacian, OfAVolumeHasTheOrderOfTheSpecification) {
    KernelBuilder builder;
    builder.result("r", builder.laplacian(builder.field_slot("a")));
    const CellKernel kernel = std::move(builder).finish();
    const Grid grid{3, 3, Boundary::periodic, 3};
    Field field{PlaneLayout(grid)};
    test::RandomStream stream(1);
    int reversed_is_different = 0;
    for (int k = 0; k < 100; ++k) {
        const auto value = [&] {
            return stream.symmetric() * static_cast<float>(1 + stream.below(99));
        };
        const float n = value(), s = value(), e = value(), w = value(), u = value(), d = value();
        const float c = value();
        field.at(1, 0, 1) = n;
        field.at(1, 2, 1) = s;
        field.at(2, 1, 1) = e;
        field.at(0, 1, 1) = w;
        field.at(1, 1, 0) = u;
        field.at(1, 1, 2) = d;
        field.at(1, 1, 1) = c;
        EXPECT_EQ(run_on(kernel, field, grid)[0].at(1, 1, 1),
                  (((((n + s) + e) + w) + u) + d) - 6 * c);
        if ((((((d + u) + w) + e) + s) + n) != (((((n + s) + e) + w) + u) + d)) {
            ++reversed_is_different;
        }
    }
    EXPECT_GT(reversed_is_different, 20);
}

// In a field whose values are positions, the value of a neighbour is its position.
TEST(Neighbour, OfAllDirections) {
    KernelBuilder builder;
    std::vector<std::array<int, 3>> offsets;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                offsets.push_back({dx, dy, dz});
                builder.result("r", builder.neighbour(builder.field_slot("a"), dx, dy, dz));
            }
        }
    }
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(verify(kernel), "");
    for (const Grid& grid : {Grid{4, 3, Boundary::periodic, 5}, Grid{4, 1, Boundary::periodic, 2},
                             Grid{4, 3, Boundary::periodic, 1}}) {
        Field field{PlaneLayout(grid)};
        const auto place = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
            return static_cast<float>((i + grid.width) % grid.width +
                                      10 * ((j + grid.height) % grid.height) +
                                      100 * ((k + grid.depth) % grid.depth));
        };
        for (std::int64_t k = 0; k < grid.depth; ++k) {
            for (std::int64_t j = 0; j < grid.height; ++j) {
                for (std::int64_t i = 0; i < grid.width; ++i) field.at(i, j, k) = place(i, j, k);
            }
        }
        const std::vector<Field> results = run_on(kernel, field, grid);
        for (std::size_t n = 0; n < offsets.size(); ++n) {
            const auto [dx, dy, dz] = offsets[n];
            for (std::int64_t k = 0; k < grid.depth; ++k) {
                for (std::int64_t j = 0; j < grid.height; ++j) {
                    for (std::int64_t i = 0; i < grid.width; ++i) {
                        ASSERT_EQ(results[n].at(i, j, k), place(i + dx, j + dy, k + dz))
                            << dx << " " << dy << " " << dz;
                    }
                }
            }
        }
    }
}

TEST(Interpreter, ResultsOfEveryKind) {
    KernelBuilder builder;
    const ValueId uniform = builder.uniform(builder.uniform_slot("u"));
    const ValueId field = builder.field(builder.field_slot("a"));
    builder.result("constant", builder.number(7));
    builder.result("uniform", uniform);
    builder.result("uniform expression", builder.multiply(uniform, builder.number(2)));
    builder.result("field", field);
    builder.result("field again", field);
    builder.result("column", builder.apply(Op::bits_to_number, builder.cell_column()));
    builder.result("row", builder.apply(Op::bits_to_number, builder.cell_row()));
    const CellKernel kernel = std::move(builder).finish();
    const Grid grid{700, 3, Boundary::periodic};
    Field a{PlaneLayout(grid)};
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 700; ++i) a.at(i, j) = static_cast<float>(i * 10 + j);
    }
    const std::vector<Field> results = run_on(kernel, a, grid);
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 700; ++i) {
            EXPECT_EQ(results[0].at(i, j), 7);
            EXPECT_EQ(results[1].at(i, j), 2.5f);
            EXPECT_EQ(results[2].at(i, j), 5);
            EXPECT_EQ(results[3].at(i, j), a.at(i, j));
            EXPECT_EQ(results[4].at(i, j), a.at(i, j));
            EXPECT_EQ(results[5].at(i, j), static_cast<float>(i));
            EXPECT_EQ(results[6].at(i, j), static_cast<float>(j));
        }
    }
}

// x ← x / 2 + 1, repeated a million times with two registers, converges to 2.
TEST(Interpreter, AMillionOperations) {
    KernelBuilder builder;
    ValueId x = builder.field(builder.field_slot("x"));
    for (int k = 0; k < 500000; ++k) {
        x = builder.add(builder.multiply(x, builder.number(0.5f)), builder.number(1));
    }
    builder.result("x", x);
    EXPECT_GT(builder.next().index(), 1000000u);
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(verify(kernel), "");
    const Grid grid{10, 1, Boundary::periodic};
    Field field{PlaneLayout(grid)};
    for (std::int64_t i = 0; i < 10; ++i) field.at(i, 0) = static_cast<float>(i * i);
    const std::vector<Field> results = run_on(kernel, field, grid);
    for (std::int64_t i = 0; i < 10; ++i) EXPECT_EQ(results[0].at(i, 0), 2);
}

// Folding and running agree: the same kernel with uniforms in place of constants gives the same
// bits.
TEST(Interpreter, FoldingIsRunning) {
    test::RandomStream stream(11);
    const Grid grid{1, 1, Boundary::periodic};
    Field none{PlaneLayout(grid)};
    for (int trial = 0; trial < 300; ++trial) {
        const float a = to_number(test::hostile_word(stream));
        const auto expand = [&](KernelBuilder& builder, ValueId x, ValueId y) {
            const ValueId sum = builder.add(x, builder.exponential(y));
            const ValueId ratio = builder.divide(sum, builder.maximum(x, y));
            return builder.minimum(builder.power(ratio, y), builder.sine(x));
        };
        KernelBuilder folding;
        const ValueId known = folding.word(to_bits(a));
        const ValueId folded = expand(folding, known, folding.number(2.5f));
        ASSERT_TRUE(folding.is_constant(folded));
        KernelBuilder running;
        const ValueId first = running.field(running.field_slot("x"));
        const ValueId second = running.uniform(running.uniform_slot("y"));
        running.result("r", expand(running, first, second));
        none.at(0, 0) = a;
        const std::vector<Field> results = run_on(std::move(running).finish(), none, grid);
        ASSERT_TRUE(test::same_word(folding[folded].slot(), to_bits(results[0].at(0, 0)))) << a;
    }
}

TEST(Evaluate, IsNotForSources) { EXPECT_DEATH(evaluate(Op::cell_row, 0, 0, 0), "source"); }

}  // namespace
}  // namespace cascade
