// What the native backend caches and refuses, and how it handles failures.
#include "core/floating_point.h"
#include "ir/builder.h"
#include "jit/jit.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace cascade::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A kernel that computes a + amount, and the Laplacian of a.
CellKernel small_kernel(float amount, const std::string& field_name = "a") {
    KernelBuilder builder;
    const FieldSlot slot = builder.field_slot(field_name);
    const ValueId sum = builder.add(builder.field(slot), builder.number(amount));
    builder.result("r", builder.add(sum, builder.laplacian(slot)));
    return std::move(builder).finish();
}

std::unique_ptr<Backend> host_jit() {
    auto made = make_jit();
    EXPECT_TRUE(made);
    return std::move(*made);
}

TEST(JitBackend, EqualKernelsAreCompiledOnce) {
    const auto jit = host_jit();
    const auto first = jit->compile(small_kernel(1), Stencil::plane);
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, *jit->compile(small_kernel(1), Stencil::plane));
    EXPECT_EQ(*first, *jit->compile(small_kernel(1, "another name"), Stencil::plane));
    EXPECT_NE(*first, *jit->compile(small_kernel(2), Stencil::plane));
    EXPECT_NE(*first, *jit->compile(small_kernel(1), Stencil::row));
    EXPECT_NE(*first, *jit->compile(small_kernel(1), Stencil::column));
}

TEST(JitBackend, KernelsOutliveTheirBackend) {
    KernelPointer kernel;
    {
        const auto jit = host_jit();
        kernel = *jit->compile(small_kernel(1), Stencil::plane);
    }
    const Grid grid{20, 3, Boundary::periodic};
    const auto results = HostileInputs(small_kernel(1), grid, 1).run(*kernel);
    const auto jit = host_jit();
    EXPECT_EQ(same_bits(results, run_kernel(*jit, small_kernel(1), grid, 1)), "");
}

TEST(JitBackend, ManyKernelsAreForgottenButThoseInUse) {
    const auto jit = make_jit({0, 0});
    ASSERT_TRUE(jit);
    const auto kept = (*jit)->compile(small_kernel(0.5f), Stencil::plane);
    ASSERT_TRUE(kept);
    for (int k = 1; k <= 1100; ++k) {
        ASSERT_TRUE((*jit)->compile(small_kernel(static_cast<float>(k)), Stencil::plane));
    }
    const Grid grid{20, 3, Boundary::periodic};
    const auto results = HostileInputs(small_kernel(0.5f), grid, 1).run(**kept);
    EXPECT_EQ(same_bits(results, run_kernel(**jit, small_kernel(0.5f), grid, 1)), "");
}

TEST(JitBackend, ThreadsMayCompileAndRunAtOnce) {
    const auto jit = host_jit();
    const Grid grid{40, 6, Boundary::periodic};
    std::vector<std::string> differences(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < differences.size(); ++t) {
        threads.emplace_back([&, t] {
            for (int k = 0; k < 8; ++k) {
                const CellKernel kernel = small_kernel(static_cast<float>(k));
                const auto once = run_kernel(*jit, kernel, grid, t);
                differences[t] += same_bits(once, run_kernel(*jit, kernel, grid, t));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::string& difference : differences) EXPECT_EQ(difference, "");
}

TEST(JitBackend, TooLargeKernelsAreRefused) {
    KernelBuilder builder;
    ValueId value = builder.field(builder.field_slot("a"));
    const ValueId factor = builder.uniform(builder.uniform_slot("p"));
    for (int k = 0; k < 25000; ++k) value = builder.multiply(builder.add(value, factor), factor);
    builder.result("r", value);
    const auto jit = host_jit();
    const auto compiled = jit->compile(std::move(builder).finish(), Stencil::plane);
    ASSERT_FALSE(compiled);
    EXPECT_THAT(compiled.error().message, HasSubstr("too large for native code"));
    EXPECT_TRUE(jit->compile(small_kernel(1), Stencil::plane)) << "the backend goes on";
}

TEST(JitBackend, KernelsWithoutResultsOrCellsDoNothing) {
    const auto jit = host_jit();
    const auto compiled = jit->compile(CellKernel{}, Stencil::plane);
    ASSERT_TRUE(compiled);
    KernelArguments arguments;
    arguments.layout = PlaneLayout(Grid{8, 8, Boundary::periodic});
    (*compiled)->run(arguments, {0, 8});
    (*compiled)->run(arguments, {5, 2});
}

TEST(JitBackend, OptionsOutOfRangeAreFailures) {
    EXPECT_FALSE(make_jit({5, 2}));
    EXPECT_FALSE(make_jit({32, 2}));
    EXPECT_FALSE(make_jit({-4, 2}));
    EXPECT_FALSE(make_jit({0, 4}));
    EXPECT_FALSE(make_jit({0, -1}));
    for (int optimise = 0; optimise <= 3; ++optimise) EXPECT_TRUE(make_jit({0, optimise}));
}

TEST(JitDump, ShowsIntermediateCodeAndAssembly) {
    const auto code = dump_llvm(small_kernel(1), Stencil::plane, {16, 2});
    ASSERT_TRUE(code);
    EXPECT_THAT(*code, HasSubstr("fadd <16 x float>"));
    EXPECT_THAT(*code, HasSubstr("preserve-sign,preserve-sign"));
    // Flags that would allow LLVM to change values.
    for (const char* flag : {"fadd fast", "nnan", "ninf", "nsz", "arcp", "contract", "reassoc"}) {
        EXPECT_THAT(*code, Not(HasSubstr(flag)));
    }
    const auto assembly = dump_assembly(small_kernel(1), Stencil::plane, {4, 2});
    ASSERT_TRUE(assembly);
    EXPECT_THAT(*assembly, HasSubstr("kernel:"));
    EXPECT_THAT(describe_jit(), HasSubstr("LLVM 19"));
}

}  // namespace
}  // namespace cascade::test
