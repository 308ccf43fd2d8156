// Runs whose kernels are interpreted at first give the same bits, whenever native code takes over.
#include "core/hash.h"
#include "ir/interpreter.h"
#include "run/simulation/simulation.h"
#if CASCADE_HAS_JIT
#include "jit/jit.h"
#endif
#include "tests/support/kernel_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A kernel that switches between two other kernels at random moments.
class RestlessKernel final : public Kernel {
public:
    RestlessKernel(KernelPointer first, KernelPointer second, std::uint32_t seed)
        : kernels_{std::move(first), std::move(second)}, seed_(seed) {}
    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        next().run(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        next().run(arguments, cells);
    }

private:
    const Kernel& next() const { return *kernels_[pcg4d({seed_, calls_++, 0, 0})[0] % 2]; }

    std::array<KernelPointer, 2> kernels_;
    std::uint32_t seed_;
    mutable std::atomic<std::uint32_t> calls_{0};
};

std::unique_ptr<Backend> native_backend() {
#if CASCADE_HAS_JIT
    return std::move(*make_jit());
#else
    return make_interpreter();
#endif
}

class RestlessBackend final : public Backend {
public:
    explicit RestlessBackend(std::uint32_t seed) : seed_(seed) {}
    std::string_view name() const override { return "restless"; }
    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        return std::make_shared<RestlessKernel>(*interpreter_->compile(kernel, stencil),
                                                *native_->compile(kernel, stencil), seed_++);
    }
    KernelPointer find(const CellKernel& kernel, Stencil stencil) override {
        return *compile(kernel, stencil);
    }

private:
    std::unique_ptr<Backend> interpreter_ = make_interpreter(), native_ = native_backend();
    std::uint32_t seed_;
};

class RefusingBackend final : public Backend {
public:
    std::string_view name() const override { return "refusing"; }
    Result<KernelPointer> compile(const CellKernel&, Stencil) override {
        return failure("it has too many corners");
    }
    KernelPointer find(const CellKernel&, Stencil) override { return nullptr; }
};

struct TieredRun {
    std::vector<Field> species;  ///< The species of all stages.
    std::vector<std::string> warnings;
    KernelCounts counts;
};

TieredRun run_tiered(const std::string& text, std::shared_ptr<TieredBackend> stepper,
                     int threads = 2) {
    Script script = load_script("test", text, ".", {});
    EXPECT_TRUE(script.program) << script.messages(false);
    SimulationOptions options;
    options.threads = threads;
    options.stepper = stepper;
    options.starts_interpreted = true;
    TieredRun ran;
    RunControl control;
    control.warn = [&](const std::string& message) { ran.warnings.push_back(message); };
    const auto simulation = Simulation::create(script, options).value();
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        EXPECT_TRUE(simulation->start_stage(k));
        EXPECT_TRUE(
            simulation->advance_stage(k, script.program->stages[k].iterations, control, {}));
        for (const Field& field : simulation->state(k).species())
            ran.species.push_back(field.clone());
    }
    ran.counts = stepper->counts();
    return ran;
}

std::shared_ptr<TieredBackend> tiered(std::unique_ptr<Backend> native) {
    return std::make_shared<TieredBackend>(std::move(native));
}

const std::vector<std::string> tiered_scripts = {
    "domain { grid: 67, 43 }\nstage a: turing_spots { iterations: 150 }\n"
    "stage b: gray_scott { iterations: 150 }",
    "domain { grid: 48, 40; precision: double }\nstage a: gray_scott { iterations: 40; solver: rk4 "
    "}",
    "domain { grid: 31, 17, 9; boundary: noflux }\nstage a: gray_scott { iterations: 40 }",
};

TEST(Tiers, SwapsAtAnyMomentChangeNoBit) {
    for (const std::string& text : tiered_scripts) {
        const TieredRun expected = run_tiered(text, tiered(make_interpreter()));
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            const TieredRun found =
                run_tiered(text, tiered(std::make_unique<RestlessBackend>(100 * seed)));
            EXPECT_EQ(same_bits(expected.species, found.species), "") << text;
        }
        const TieredRun swapped = run_tiered(text, tiered(native_backend()));
        EXPECT_EQ(same_bits(expected.species, swapped.species), "") << text;
        EXPECT_THAT(swapped.warnings, IsEmpty());
    }
}

TEST(Tiers, WhatIsRefusedLateIsSaidBehindTheStage) {
    // The stage has so many steps that the refusal comes before its end.
    const std::string text = "domain { grid: 32, 32 }\nstage a: turing_spots { iterations: 8000 }";
    const TieredRun ran = run_tiered(text, tiered(std::make_unique<RefusingBackend>()));
    EXPECT_THAT(ran.warnings,
                ElementsAre(
                    HasSubstr("stage 'a' is interpreted, which is slow: it has too many corners")));
}

TEST(Tiers, WhatIsRefusedWhenTheRunIsOverIsSaidToo) {
    // A backend that refuses a kernel only after all steps were taken. There are too few steps to
    // wait for its code.
    class SlowBackend final : public Backend {
    public:
        std::string_view name() const override { return "slow"; }
        Result<KernelPointer> compile(const CellKernel&, Stencil) override {
            while (!is_over) std::this_thread::yield();
            return failure("it has too many corners");
        }
        KernelPointer find(const CellKernel&, Stencil) override { return nullptr; }
        std::atomic<bool> is_over = false;
    };
    auto slow = std::make_unique<SlowBackend>();
    SlowBackend& backend = *slow;
    Script script =
        load_script("test", "domain { grid: 32, 32 }\nstage a: turing_spots { iterations: 120 }",
                    ".", {});
    ASSERT_TRUE(script.program);
    SimulationOptions options;
    options.stepper = tiered(std::move(slow));
    options.starts_interpreted = true;
    const auto simulation = Simulation::create(script, options).value();
    std::vector<std::string> warnings;
    RunControl control;
    control.warn = [&](const std::string& message) { warnings.push_back(message); };
    ASSERT_TRUE(simulation->start_stage(0));
    ASSERT_TRUE(simulation->advance_stage(0, 120, control, {}));
    EXPECT_THAT(warnings, IsEmpty());
    backend.is_over = true;
    simulation->settle(control);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr(
                              "stage 'a' is interpreted, which is slow: it has too many corners")));
    simulation->settle(control);
    EXPECT_EQ(warnings.size(), 1u);
}

TEST(Tiers, AShortRunCompilesNothing) {
    if (!is_available("jit")) GTEST_SKIP() << "there is no compiler";
    const std::string text =
        "domain { grid: 64, 64 }\nstage a: turing_spots { iterations: 3 }\n"
        "stage b: gray_scott { iterations: 3 }";
    const auto stepper = tiered(native_backend());
    run_tiered(text, stepper);
    EXPECT_EQ(stepper->counts().compiled, 0);
}

TEST(Tiers, LaterStagesAreCompiledAhead) {
    if (!is_available("jit")) GTEST_SKIP() << "there is no compiler";
    Script script =
        load_script("test",
                    "domain { grid: 64, 64 }\nstage a: turing_spots { iterations: 1000 }\n"
                    "stage b: gray_scott { iterations: 1000 }",
                    ".", {});
    ASSERT_TRUE(script.program);
    SimulationOptions options;
    options.stepper = tiered(native_backend());
    options.starts_interpreted = true;
    const auto simulation = Simulation::create(script, options).value();
    RunControl control;
    ASSERT_TRUE(simulation->start_stage(0));
    ASSERT_TRUE(simulation->advance_stage(0, 1, control, {}));
    while (options.stepper->counts().compiled < 2) std::this_thread::yield();
    ASSERT_TRUE(simulation->start_stage(1));
    ASSERT_TRUE(simulation->advance_stage(1, 1000, control, {}));
    EXPECT_EQ(options.stepper->counts().compiled, 2) << "what was compiled ahead is what runs";
}

}  // namespace
}  // namespace cascade::test
