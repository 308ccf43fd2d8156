// Kernels that are interpreted until they are compiled: when they are compiled, and when
// compilation is skipped.
#include "ir/interpreter.h"
#include "ir/tiered_backend.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_kernels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <thread>

namespace cascade::test {
namespace {

using When = TieredBackend::When;

/// Counts the calls of an interpreted kernel.
class CountedKernel final : public Kernel {
public:
    CountedKernel(KernelPointer kernel, std::shared_ptr<std::atomic<int>> calls)
        : kernel_(std::move(kernel)), calls_(std::move(calls)) {}
    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        ++*calls_;
        kernel_->run(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        ++*calls_;
        kernel_->run(arguments, cells);
    }

private:
    KernelPointer kernel_;
    std::shared_ptr<std::atomic<int>> calls_;
};

/// Lets a test observe and control a compiler.
struct Workshop {
    enum class Way { compiles, refuses, has_no_memory };

    std::mutex mutex;
    std::condition_variable changed;
    int allowed = 0, begun = 0, done = 0;  ///< Numbers of compilations.
    Way way = Way::compiles;
    std::shared_ptr<std::atomic<int>> native_calls = std::make_shared<std::atomic<int>>(0);

    void allow(int more) {
        const std::lock_guard lock(mutex);
        allowed += more;
        changed.notify_all();
    }
    void wait_for(const int& count, int value) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return count >= value; });
    }
    int count(const int& what) {
        const std::lock_guard lock(mutex);
        return what;
    }
};

/// A compiler that waits for permission and makes counted kernels.
class SlowBackend final : public Backend {
public:
    explicit SlowBackend(std::shared_ptr<Workshop> workshop) : workshop_(std::move(workshop)) {}
    std::string_view name() const override { return "slow"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        Workshop& shop = *workshop_;
        std::unique_lock lock(shop.mutex);
        ++shop.begun;
        shop.changed.notify_all();
        shop.changed.wait(lock, [&] { return shop.done < shop.allowed; });
        ++shop.done;
        shop.changed.notify_all();
        if (shop.way == Workshop::Way::refuses) return failure("a kernel nobody can compile");
        if (shop.way == Workshop::Way::has_no_memory) throw std::bad_alloc();
        made_ = std::make_shared<CountedKernel>(*make_interpreter()->compile(kernel, stencil),
                                                shop.native_calls);
        return made_;
    }
    KernelPointer find(const CellKernel&, Stencil) override {
        const std::lock_guard lock(workshop_->mutex);
        return made_;
    }

private:
    std::shared_ptr<Workshop> workshop_;
    KernelPointer made_;  ///< The last kernel. Tests of find() compile only one.
};

class TieredBackendTest : public ::testing::Test {
protected:
    TieredBackendTest()
        : backend_(std::make_unique<TieredBackend>(std::make_unique<SlowBackend>(shop_))) {}
    ~TieredBackendTest() override { shop_->allow(1000); }

    static CellKernel kernel() {
        RandomKernelOptions options;
        options.operations = 30;
        return random_kernel(7, options);
    }
    KernelPointer begin(When when) { return backend_->begin(kernel(), Stencil::plane, when); }
    /// Waits until the form of a kernel is final.
    static void settle(const Kernel& kernel) {
        while (kernel.is_provisional()) std::this_thread::yield();
    }
    int native_calls() const { return *shop_->native_calls; }
    /// Runs a kernel so often that calls wait until it is compiled.
    void run_often(const Kernel& kernel, std::atomic<int>& calls) const {
        for (; calls < interpreted_calls + 50; ++calls) inputs_.run(kernel);
    }

    /// The number of calls for the whole grid that are interpreted before a call waits. Each row
    /// counts as if it had 64 more cells.
    static constexpr int interpreted_calls = cells_worth_compiling / (9 * (40 + 64));

    Grid grid_{40, 9, Boundary::periodic};
    HostileInputs inputs_{kernel(), grid_, 3};
    std::vector<Field> expected_ = run_kernel(*make_interpreter(), kernel(), grid_, 3);
    std::shared_ptr<Workshop> shop_ = std::make_shared<Workshop>();
    std::unique_ptr<TieredBackend> backend_;
};

TEST_F(TieredBackendTest, KernelsRunBeforeAndBehindTheSwap) {
    const KernelPointer begun = begin(When::now);
    shop_->wait_for(shop_->begun, 1);
    EXPECT_TRUE(begun->is_provisional());
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
    EXPECT_EQ(native_calls(), 0);
    shop_->allow(1);
    settle(*begun);
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
    EXPECT_EQ(native_calls(), 1);
    EXPECT_EQ(begun->refusal(), nullptr);
}

TEST_F(TieredBackendTest, WhatMayBeShortIsCompiledOnceItHasRunForLong) {
    const KernelPointer begun = begin(When::when_used);
    for (int k = 0; k < interpreted_calls; ++k) inputs_.run(*begun);
    EXPECT_EQ(shop_->count(shop_->begun), 0);
    shop_->allow(1);
    inputs_.run(*begun);
    settle(*begun);
    EXPECT_EQ(shop_->count(shop_->begun), 1);
    const int before = native_calls();
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
    EXPECT_EQ(native_calls(), before + 1);
}

TEST_F(TieredBackendTest, WhatHasBeenInterpretedForLongWaitsForItsCode) {
    const KernelPointer begun = begin(When::now);
    std::atomic<int> calls{0};
    std::thread thread([&] { run_often(*begun, calls); });
    while (calls < interpreted_calls) std::this_thread::yield();
    shop_->allow(1);
    thread.join();
    EXPECT_EQ(native_calls(), calls - interpreted_calls);
}

TEST_F(TieredBackendTest, NobodyWaitsForWhatIsAbandoned) {
    const KernelPointer first = begin(When::now), second = begin(When::now);
    shop_->wait_for(shop_->begun, 1);
    std::atomic<int> calls{0};
    std::thread thread([&] { run_often(*second, calls); });
    while (calls < interpreted_calls) std::this_thread::yield();
    backend_->abandon();
    thread.join();
    EXPECT_EQ(native_calls(), 0);
    EXPECT_TRUE(second->is_provisional());
}

TEST_F(TieredBackendTest, RefusedKernelsStayInterpretedAndSayWhy) {
    shop_->way = Workshop::Way::refuses;
    const KernelPointer begun = begin(When::now);
    EXPECT_EQ(begun->refusal(), nullptr);
    shop_->allow(1);
    settle(*begun);
    ASSERT_NE(begun->refusal(), nullptr);
    EXPECT_EQ(begun->refusal()->message, "a kernel nobody can compile");
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
    EXPECT_EQ(native_calls(), 0);
}

TEST_F(TieredBackendTest, WithoutMemoryForACompilerRunsGoOn) {
    shop_->way = Workshop::Way::has_no_memory;
    const KernelPointer begun = begin(When::now);
    backend_->expect(kernel(), Stencil::row);
    shop_->allow(2);
    shop_->wait_for(shop_->done, 2);
    settle(*begun);
    ASSERT_NE(begun->refusal(), nullptr);
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
}

TEST_F(TieredBackendTest, WhatIsExpectedIsFound) {
    backend_->expect(kernel(), Stencil::plane);
    shop_->allow(1);
    shop_->wait_for(shop_->done, 1);
    while (!backend_->find(kernel(), Stencil::plane)) std::this_thread::yield();
    const KernelPointer begun = begin(When::when_used);
    EXPECT_FALSE(begun->is_provisional());
    EXPECT_EQ(same_bits(inputs_.run(*begun), expected_), "");
    EXPECT_EQ(native_calls(), 1);
}

TEST_F(TieredBackendTest, ABackendEndsWithWhatIsWantedAndNoMore) {
    const KernelPointer first = begin(When::now), second = begin(When::now);
    const KernelPointer unused = begin(When::when_used);
    shop_->wait_for(shop_->begun, 1);
    backend_->expect(kernel(), Stencil::row);
    std::thread end([&] { backend_.reset(); });
    shop_->allow(10);
    end.join();
    // The kernel that was only expected may be compiled, too, if its compilation began before the
    // end.
    EXPECT_GE(shop_->count(shop_->done), 2);
    for (const KernelPointer& kernel : {first, second, unused}) {
        EXPECT_EQ(same_bits(inputs_.run(*kernel), expected_), "");
    }
    EXPECT_EQ(native_calls(), 2);
    // Calls must not wait for a thread, since none is left.
    for (int k = 0; k < 1000; ++k) inputs_.run(*unused);
    EXPECT_TRUE(unused->is_provisional());
}

TEST_F(TieredBackendTest, AbandonedKernelsStayAsTheyAre) {
    const KernelPointer first = begin(When::now), second = begin(When::now);
    shop_->wait_for(shop_->begun, 1);
    backend_->expect(kernel(), Stencil::row);
    backend_->abandon();
    shop_->allow(10);
    backend_.reset();
    EXPECT_EQ(shop_->count(shop_->done), 1);
    EXPECT_EQ(same_bits(inputs_.run(*second), expected_), "");
    EXPECT_EQ(native_calls(), 0);
    EXPECT_EQ(same_bits(inputs_.run(*first), expected_), "");
    EXPECT_EQ(native_calls(), 1);
}

TEST_F(TieredBackendTest, SwapsUnderRunningThreadsAreSafe) {
    for (int round = 0; round < 50; ++round) {
        // A separate backend, since a stored kernel would not be compiled.
        TieredBackend backend(std::make_unique<SlowBackend>(shop_));
        const KernelPointer begun = backend.begin(kernel(), Stencil::plane, When::now);
        std::vector<std::string> differences(3);
        std::vector<std::thread> threads;
        for (std::string& difference : differences) {
            threads.emplace_back([&] {
                do {
                    difference += same_bits(inputs_.run(*begun), expected_);
                } while (begun->is_provisional());
                difference += same_bits(inputs_.run(*begun), expected_);
            });
        }
        shop_->allow(1);
        for (std::thread& thread : threads) thread.join();
        for (const std::string& difference : differences) EXPECT_EQ(difference, "");
    }
    EXPECT_GE(native_calls(), 150);
}

TEST(TieredInterpreter, NeedsNoTiers) {
    TieredBackend backend(make_interpreter());
    const KernelPointer kernel = backend.begin(random_kernel(1, {}), Stencil::plane, When::now);
    EXPECT_FALSE(kernel->is_provisional());
    EXPECT_EQ(backend.name(), "interp");
}

}  // namespace
}  // namespace cascade::test
