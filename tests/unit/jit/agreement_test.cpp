// Native code and the interpreter compute the same bits: random kernels, hostile numbers, all
// vector widths, stencils and shapes of grids.
#include "ir/builder.h"
#include "ir/contraction.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"
#include "jit/jit.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/new_seed.h"
#include "tests/support/random_kernels.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>

namespace cascade::test {
namespace {

std::unique_ptr<Backend> jit_of(int lanes, int optimise) {
    auto made = make_jit({lanes, optimise});
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : nullptr;
}

/// Compares one kernel on one grid. Describes the first difference or a stray write.
std::string difference(Backend& jit, const CellKernel& kernel, const Grid& grid,
                       std::uint64_t seed) {
    const auto compiled = jit.compile(kernel, grid.stencil());
    if (!compiled) return compiled.error().message;
    const HostileInputs inputs(kernel, grid, seed);
    const Patch all{{0, PlaneLayout(grid).row_count()}};
    const std::vector<Field> results = inputs.run(**compiled, all);
    const std::string stray = stray_writes(results, all);
    if (!stray.empty()) return stray;
    const auto interpreter = make_interpreter();
    return same_bits(run_kernel(*interpreter, kernel, grid, seed), results);
}

std::string describe(const Grid& grid) {
    return fmt::format("{} × {} × {}", grid.width, grid.height, grid.depth);
}

struct Backends {
    std::unique_ptr<Backend> plain[3] = {jit_of(4, 0), jit_of(8, 0), jit_of(16, 0)};
    std::unique_ptr<Backend> optimised[3] = {jit_of(4, 2), jit_of(8, 2), jit_of(16, 2)};
};

// Each kernel is compiled for two widths. Over all kernels, every combination occurs.
void compare_random_kernels(Precision precision, std::uint64_t count, bool links = false,
                            std::uint64_t first_seed = 1) {
    Backends backends;
    OperationCounts hit;
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        RandomKernelOptions options;
        options.precision = precision;
        options.links = links;
        options.operations = 6 + static_cast<int>(seed % 20);
        options.results = 1 + static_cast<int>(seed % 3);
        options.composed_percent = seed % 8 == 0 ? 8 : 0;
        const CellKernel kernel = random_kernel(seed, options);
        hit.add(kernel);
        const Grid grid = links ? random_linked_grid(seed, 67, 5) : random_grid(seed, 67, 5, 3);
        SCOPED_TRACE(fmt::format("seed {}, grid {}", seed, describe(grid)));
        ASSERT_EQ(difference(*backends.plain[seed % 3], kernel, grid, seed), "")
            << "without optimisation\n"
            << print(kernel);
        ASSERT_EQ(difference(*backends.optimised[(seed / 3) % 3], kernel, grid, seed), "")
            << "optimised\n"
            << print(kernel);
    }
    if (first_seed != 1) return;
    EXPECT_EQ(hit.missing(links), "") << "operations that were never tried";
    std::printf("operations in %d kernels:\n%s", static_cast<int>(count), hit.report().c_str());
}

TEST(JitAgreement, RandomKernels) { compare_random_kernels(Precision::single, 1600); }
TEST(JitAgreement, RandomKernelsOfBinary64) { compare_random_kernels(Precision::binary64, 1600); }
TEST(JitAgreement, RandomKernelsOfLinkedCells) {
    compare_random_kernels(Precision::single, 800, true);
    compare_random_kernels(Precision::binary64, 800, true);
}

/// Kernels from new seeds.
TEST(JitAgreement, NewRandomKernels) {
    const std::uint64_t seed = new_seed() + 2;  // Seeds of the other tests begin at 1.
    compare_random_kernels(Precision::single, 800, false, seed);
    compare_random_kernels(Precision::binary64, 800, false, seed);
    compare_random_kernels(Precision::single, 200, true, seed);
}

// Contracted kernels are valid, and both executors agree on them.
TEST(JitAgreement, ContractedKernels) {
    if (!has_multiply_add()) GTEST_SKIP() << "this processor has no multiply-add";
    Backends backends;
    std::size_t fused = 0;
    for (std::uint64_t seed = 1; seed <= 1200; ++seed) {
        RandomKernelOptions options;
        options.precision = seed % 2 == 0 ? Precision::single : Precision::binary64;
        options.operations = 10 + static_cast<int>(seed % 30);
        options.composed_percent = seed % 8 == 0 ? 8 : 0;
        options.links = seed % 3 == 0;
        const CellKernel strict = random_kernel(seed, options), kernel = contracted(strict);
        ASSERT_EQ(verify(kernel), "");
        OperationCounts before, after;
        before.add(strict);
        after.add(kernel);
        const auto index = static_cast<std::size_t>(Op::multiply_add);
        fused += after.counts[index] - before.counts[index];
        const Grid grid =
            options.links ? random_linked_grid(seed, 67, 5) : random_grid(seed, 67, 5, 3);
        SCOPED_TRACE(fmt::format("seed {}, grid {}", seed, describe(grid)));
        ASSERT_EQ(difference(*backends.plain[seed % 3], kernel, grid, seed), "") << print(kernel);
        ASSERT_EQ(difference(*backends.optimised[(seed / 3) % 3], kernel, grid, seed), "")
            << print(kernel);
    }
    EXPECT_GT(fused, 200u);
}

/// A kernel with all sums over links of two fields, and values that depend on the cell's position.
CellKernel kernel_of_links(Precision precision) {
    KernelBuilder builder(precision);
    const FieldSlot a = builder.field_slot("a"), b = builder.field_slot("b");
    builder.result("heat", builder.add(builder.field(a), builder.laplacian(a)));
    builder.result("flow", builder.add(builder.link_flow({b, a}), builder.link_flow({a, b})));
    builder.result("squares", builder.over_links(Op::link_squares, b));
    const ValueId x = builder.over_links(Op::gradient_x, a);
    const ValueId y = builder.over_links(Op::gradient_y, a);
    builder.result("slope", builder.multiply(x, y));
    const ValueId column = builder.apply(Op::bits_to_number, builder.cell_column());
    builder.result("place", builder.select(builder.mask(builder.mask_slot("m")), column,
                                           builder.over_links(Op::gradient_z, b)));
    return std::move(builder).finish();
}

/// A kernel with reductions in two loops over links.
CellKernel kernel_of_reductions(Precision precision) {
    KernelBuilder builder(precision);
    const FieldSlot a = builder.field_slot("a"), b = builder.field_slot("b");
    const ValueId apart = builder.subtract(builder.theirs(a), builder.field(a));
    const ValueId mean =
        builder.divide(builder.link_sum(apart), builder.link_sum(builder.number(1)));
    builder.result("least", builder.link_least(apart));
    builder.result("spread", builder.link_sum(builder.apply(
                                 Op::absolute, builder.subtract(builder.theirs(b), mean))));
    const ValueId is_less = builder.apply(Op::less, builder.theirs(b), mean);
    builder.result("greatest",
                   builder.link_greatest(builder.select(is_less, builder.field(a), apart)));
    builder.result("mean", mean);
    return std::move(builder).finish();
}

// One cell, rows of one cell, and partly filled slices. Each cell has links to all cells.
TEST(JitAgreement, EveryShapeOfRowsOfLinkedCells) {
    Backends backends;
    for (const CellKernel& kernel :
         {kernel_of_links(Precision::single), kernel_of_links(Precision::binary64),
          kernel_of_reductions(Precision::single), kernel_of_reductions(Precision::binary64)}) {
        for (std::int64_t width = 1; width <= 50; ++width) {
            for (std::int64_t height = 1; height <= 4; ++height) {
                Grid grid{width, height};
                grid.linked = true;
                const auto seed = static_cast<std::uint64_t>(width * height);
                for (const auto& backend : backends.optimised) {
                    ASSERT_EQ(difference(*backend, kernel, grid, seed), "") << describe(grid);
                }
            }
        }
    }
}

// Most offsets of links exceed 16 bits, so entries of a slice have bases of their own.
TEST(JitAgreement, LinksThatLeadFar) {
    Backends backends;
    for (const CellKernel& kernel :
         {kernel_of_links(Precision::single), kernel_of_links(Precision::binary64),
          kernel_of_reductions(Precision::single), kernel_of_reductions(Precision::binary64)}) {
        Grid grid{40, 1000};
        grid.linked = true;
        for (const auto& backend : backends.optimised) {
            ASSERT_EQ(difference(*backend, kernel, grid, 1), "");
        }
    }
}

TEST(JitAgreement, LargeKernels) {
    Backends backends;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        RandomKernelOptions options;
        options.precision = seed % 2 == 0 ? Precision::single : Precision::binary64;
        options.operations = 300;
        options.composed_percent = 2;
        const CellKernel kernel = random_kernel(seed + 100000, options);
        const Grid grid = random_grid(seed, 67, 5, 3);
        SCOPED_TRACE(fmt::format("seed {}", seed));
        ASSERT_EQ(difference(*backends.plain[seed % 3], kernel, grid, seed), "");
        ASSERT_EQ(difference(*backends.optimised[seed % 3], kernel, grid, seed), "");
    }
}

// Kernels above a size are compiled by the simple code generator.
TEST(JitAgreement, HugeKernels) {
    Backends backends;
    KernelBuilder builder;
    const ValueId own = builder.field(builder.field_slot("a"));
    const ValueId factor = builder.uniform(builder.uniform_slot("p"));
    ValueId value = builder.laplacian(builder.field_slot("b"));
    for (int k = 0; k < 1000; ++k) {
        const ValueId product = builder.multiply(builder.add(value, own), factor);
        const ValueId rest = builder.subtract(value, builder.number(static_cast<float>(k)));
        value = builder.select(builder.apply(Op::less, rest, own), product, rest);
    }
    builder.result("r", value);
    const CellKernel kernel = std::move(builder).finish();
    ASSERT_GT(kernel.code.size(), 3000u);
    for (const auto& backend : backends.optimised) {
        ASSERT_EQ(difference(*backend, kernel, Grid{50, 2, Boundary::periodic}, 1), "");
    }
}

/// A kernel that reads everything that depends on position.
CellKernel kernel_of_place() {
    KernelBuilder builder;
    const ValueId lap = builder.laplacian(builder.field_slot("a"));
    const ValueId other = builder.laplacian(builder.field_slot("b"));
    const auto times = [&](ValueId count, std::uint32_t factor) {
        return builder.apply(Op::bits_multiply, count, builder.word(factor));
    };
    const ValueId place =
        builder.apply(Op::bits_to_number,
                      builder.apply(Op::bits_add, times(builder.cell_slice(), 100000),
                                    builder.apply(Op::bits_add, times(builder.cell_row(), 1000),
                                                  builder.cell_column())));
    ValueId corners = builder.number(0);
    for (int corner = 0; corner < 8; ++corner) {
        const auto offset = [&](int bit) { return (corner & bit) != 0 ? 1 : -1; };
        corners = builder.add(corners, builder.neighbour(builder.field_slot("a"), offset(1),
                                                         offset(2), offset(4)));
    }
    builder.result("corners", corners);
    builder.result("lap", builder.add(lap, builder.field(builder.field_slot("a"))));
    builder.result("place", place);
    builder.result("all", builder.select(builder.mask(builder.mask_slot("m")), place, other));
    return std::move(builder).finish();
}

TEST(JitAgreement, EveryShapeOfGrid) {
    Backends backends;
    const CellKernel kernel = kernel_of_place();
    for (std::int64_t width = 1; width <= 67; ++width) {
        for (std::int64_t height = 1; height <= 5; ++height) {
            for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
                // Each width and height is also tested with one of three depths above 1.
                for (const std::int64_t depth : {std::int64_t{1}, 2 + (width + height) % 3}) {
                    const Grid grid{width, height, boundary, depth};
                    for (const auto& backend : backends.optimised) {
                        ASSERT_EQ(difference(*backend, kernel, grid, 7), "") << describe(grid);
                    }
                }
            }
        }
    }
}

// For wide planes, another copy of the loop's body prefetches.
TEST(JitAgreement, WidePlanes) {
    Backends backends;
    for (const std::int64_t width : {127, 128, 129, 300, 1030}) {
        for (const auto& backend : backends.optimised) {
            const Grid grid{width, 3, Boundary::periodic};
            for (const std::uint64_t seed : {3u, 4u}) {  // The inputs count as far, then as near.
                ASSERT_EQ(difference(*backend, kernel_of_place(), grid, seed), "")
                    << describe(grid);
                ASSERT_EQ(difference(*backend, random_kernel(5), grid, seed), "") << describe(grid);
            }
        }
    }
}

/// Two species that diffuse, with little arithmetic: loads are the limit.
CellKernel diffusion_kernel(Precision precision) {
    KernelBuilder builder(precision);
    for (const char* name : {"a", "b"}) {
        const FieldSlot slot = builder.field_slot(name);
        const ValueId rate = builder.uniform(builder.uniform_slot("d"));
        builder.result(name, builder.add(builder.field(slot),
                                         builder.multiply(rate, builder.laplacian(slot))));
    }
    return std::move(builder).finish();
}

/// Describes the first row whose columns −1 and width are not as `columns` says. Empty if there is
/// no such row.
template <typename Number>
std::string wrong_columns(const Field& field, RowRange rows, HaloColumns columns) {
    const std::int64_t width = field.layout().width;
    for (std::int64_t row = rows.begin; row < rows.end; ++row) {
        const Number* cells = field.row<Number>(row);
        const auto differ = [&](std::int64_t a, std::int64_t b) {
            return std::memcmp(cells + a, cells + b, sizeof(Number)) != 0;
        };
        if (differ(-1, columns.left)) return fmt::format("left of row {}", row);
        if (differ(width, columns.right)) return fmt::format("right of row {}", row);
    }
    return "";
}

void expect_columns(const CellKernel& kernel, const Kernel& native, const Grid& grid, RowRange rows,
                    HaloColumns columns) {
    HostileInputs inputs(kernel, grid, 3);
    inputs.fill_columns(columns);
    ASSERT_TRUE(native.fills_columns());
    const std::vector<Field> results = inputs.run(native, {rows});
    ASSERT_EQ(stray_writes(results, {rows}, true), "") << describe(grid);
    for (const Field& field : results) {
        const std::string wrong = with_number(kernel.precision, [&](auto zero) {
            return wrong_columns<decltype(zero)>(field, rows, columns);
        });
        ASSERT_EQ(wrong, "") << describe(grid);
    }
}

TEST(JitAgreement, ColumnsOfTheHaloAreFilledWhereThatIsAsked) {
    Backends backends;
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        const CellKernel kernel = diffusion_kernel(precision);
        for (const std::int64_t width : {2, 15, 16, 17, 64, 150}) {
            for (const std::int64_t height : {1, 5}) {
                const Grid grid{width, height};
                for (const auto& backend : backends.optimised) {
                    const KernelPointer native = backend->compile(kernel, grid.stencil()).value();
                    expect_columns(kernel, *native, grid, {0, height}, {width - 1, 0});
                    expect_columns(kernel, *native, grid, {height / 2, height}, {0, width - 1});
                    expect_columns(kernel, *native, grid, {0, height}, {width - 1, width - 1});
                    if (width <= 16) continue;
                    HostileInputs inputs(kernel, grid, 3);
                    inputs.fill_columns({0, width - 1});
                    const Patch part{{0, height}, {.begin = 16}};  // Fills no column.
                    ASSERT_EQ(stray_writes(inputs.run(*native, part), part), "");
                }
            }
        }
    }
}

// If loads are the limit, the loop carries vectors from one iteration to the next.
TEST(JitAgreement, KernelsOfManyLoads) {
    Backends backends;
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        const CellKernel kernel = diffusion_kernel(precision);
        for (std::int64_t width = 1; width <= 131; ++width) {
            for (const Grid& grid : {Grid{width, 3, Boundary::periodic}, Grid{width, 1, {}},
                                     Grid{width, 2, Boundary::no_flux, 2}}) {
                for (const auto& backend : backends.optimised) {
                    ASSERT_EQ(difference(*backend, kernel, grid, 5), "") << describe(grid);
                }
            }
        }
    }
}

void expect_equal_in(const Patch& cells, const Field& part, const Field& whole) {
    const ColumnRange columns = cells.columns.within(whole.layout().width);
    for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
        for (std::int64_t i = columns.begin; i < columns.end; ++i) {
            const float expected = whole.row(row)[i];
            if (expected != expected) continue;
            ASSERT_EQ(to_bits(part.row(row)[i]), to_bits(expected)) << "column " << i;
        }
    }
}

TEST(JitAgreement, PartsOfTheCellsMakeTheWhole) {
    const Backends backends;
    const std::vector<Patch> patches{{{0, 4}},           {{4, 5}},       {{5, 9}},
                                     {{3, 3}},           {{2, 7}},       {{0, 9}, {0, 16}},
                                     {{1, 6}, {16, 32}}, {{0, 9}, {16}}, {{4, 5}, {32}}};
    for (const CellKernel& kernel : {kernel_of_place(), diffusion_kernel(Precision::single)}) {
        for (const Grid& grid : {Grid{37, 9}, Grid{37, 3, {}, 3}}) {
            const HostileInputs inputs(kernel, grid, 11);
            for (const auto& backend : backends.optimised) {
                const auto compiled = backend->compile(kernel, grid.stencil());
                ASSERT_TRUE(compiled);
                const std::vector<Field> whole = inputs.run(**compiled);
                for (const Patch& cells : patches) {
                    const std::vector<Field> part = inputs.run(**compiled, cells);
                    EXPECT_EQ(stray_writes(part, cells), "");
                    for (std::size_t k = 0; k < whole.size(); ++k) {
                        expect_equal_in(cells, part[k], whole[k]);
                    }
                }
            }
        }
    }
}

// Identities that LLVM uses, but that do not hold if denormals are flushed. The kernels are written
// by hand, since the builder folds some of them.
TEST(JitAgreement, FlushingIsNotOptimisedAway) {
    using Code = IdVector<ValueId, Instruction>;
    const auto word = [](std::uint32_t bits) { return Instruction{Op::constant, {}, bits}; };
    const Instruction x{Op::field, {}, 0}, y{Op::field, {}, 1};
    const auto on = [](Op op, std::size_t a, std::size_t b = 0, std::size_t c = 0) {
        return Instruction{op, {ValueId(a), ValueId(b), ValueId(c)}, 0};
    };
    const std::array<Code, 16> cases{{
        {x, word(0x3f800000), on(Op::multiply, 0, 1)},
        {x, word(0xbf800000), on(Op::multiply, 1, 0)},
        {x, word(0x3f800000), on(Op::divide, 0, 1)},
        {x, word(0xbf800000), on(Op::divide, 0, 1)},
        {x, word(0), on(Op::add, 0, 1)},
        {x, word(0x80000000), on(Op::add, 1, 0)},
        {x, word(0), on(Op::subtract, 0, 1)},
        {x, word(0x80000000), on(Op::subtract, 0, 1)},
        {x, word(0x80000000), on(Op::subtract, 1, 0)},
        {x, on(Op::absolute, 0), word(0), on(Op::add, 1, 2)},
        {x, on(Op::bits_xor, 0, 0), on(Op::subtract, 0, 1)},
        {x, y, on(Op::less, 0, 1), on(Op::select, 2, 0, 1)},
        {x, y, on(Op::less, 1, 0), on(Op::select, 2, 0, 1)},
        {x, y, on(Op::equal, 0, 1), on(Op::select, 2, 0, 1)},
        {x, word(0x00000123), on(Op::less, 0, 1), on(Op::select, 2, 1, 0)},
        {word(0x00000123), on(Op::square_root, 0), word(0x71000000), on(Op::multiply, 0, 2),
         on(Op::add, 1, 3)},
    }};
    Backends backends;
    for (const Code& code : cases) {
        CellKernel kernel{code, {ValueId(code.size() - 1)}, {"x", "y"}, {}, {}, {"r"}};
        ASSERT_EQ(verify(kernel), "");
        for (int width = 0; width < 3; ++width) {
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                const Grid grid{64, 4, Boundary::periodic};
                EXPECT_EQ(difference(*backends.plain[width], kernel, grid, seed), "")
                    << print(kernel);
                EXPECT_EQ(difference(*backends.optimised[width], kernel, grid, seed), "")
                    << print(kernel);
            }
        }
    }
}

// Multiply-adds with a factor of 1 or an addend of 0 must not be removed, since they flush denormal
// numbers.
TEST(JitAgreement, MultiplyAddsFlush) {
    if (!has_multiply_add()) GTEST_SKIP() << "this processor has none";
    Backends backends;
    constexpr std::uint32_t words[] = {0x3f800000, 0xbf800000, 0,         0x80000000,
                                       0x40000000, 0x00000123, 0x80400000};
    for (const std::uint32_t factor : words) {
        for (const std::uint32_t added : words) {
            for (const bool adds_field : {false, true}) {
                KernelBuilder builder;
                const ValueId x = builder.field(builder.field_slot("x"));
                const ValueId a = builder.word(factor), b = builder.word(added);
                builder.result("r", adds_field ? builder.apply(Op::multiply_add, a, b, x)
                                               : builder.apply(Op::multiply_add, x, a, b));
                const CellKernel kernel = std::move(builder).finish();
                for (int width = 0; width < 3; ++width) {
                    const Grid grid{64, 4, Boundary::periodic};
                    EXPECT_EQ(difference(*backends.plain[width], kernel, grid, 1), "")
                        << print(kernel);
                    EXPECT_EQ(difference(*backends.optimised[width], kernel, grid, 1), "")
                        << print(kernel);
                }
            }
        }
    }
}

// LLVM's folding of this kernel would read beyond the end of the unfinished block.
TEST(JitAgreement, ChoicesAreComparedInFrontOfTheLoops) {
    for (const bool in_row : {false, true}) {
        KernelBuilder builder;
        const ValueId number =
            in_row ? builder.cell_row() : builder.uniform(builder.uniform_slot("p"));
        const ValueId differs = builder.apply(Op::not_equal, builder.word(1), number);
        const ValueId sum = builder.apply(Op::bits_add, differs, builder.word(0x00400000));
        const ValueId choice = builder.select(number, differs, builder.number(0));
        const ValueId is_zero = builder.apply(Op::logical_not, builder.apply(Op::absolute, sum));
        builder.result("r", builder.apply(Op::equal, is_zero, choice));
        const CellKernel kernel = std::move(builder).finish();
        const auto jit = jit_of(0, 2);
        EXPECT_EQ(difference(*jit, kernel, Grid{20, 3, Boundary::periodic}, 1), "");
    }
}

// LLVM would draw wrong conclusions from an unfinished loop.
TEST(JitAgreement, TheFirstRowIsNumberZero) {
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        KernelBuilder builder(precision);
        const ValueId row = builder.cell_row();
        const ValueId is_after = builder.apply(Op::bits_to_number, row);
        builder.result("r", builder.select(is_after, row, builder.number(7)));
        const CellKernel kernel = std::move(builder).finish();
        EXPECT_EQ(difference(*jit_of(0, 2), kernel, Grid{20, 3, Boundary::periodic}, 1), "");
    }
}

// The comparison itself works: a kernel that differs in one operation is found.
TEST(JitAgreement, AnotherKernelDiffers) {
    const auto jit = jit_of(0, 2);
    KernelBuilder first, second;
    const Grid grid{20, 3, Boundary::periodic};
    first.result("r", first.add(first.field(first.field_slot("a")), first.number(1)));
    second.result("r", second.subtract(second.field(second.field_slot("a")), second.number(1)));
    const CellKernel one = std::move(first).finish();
    const CellKernel other = std::move(second).finish();
    EXPECT_NE(same_bits(run_kernel(*jit, one, grid, 1), run_kernel(*jit, other, grid, 1)), "");
}

}  // namespace
}  // namespace cascade::test
