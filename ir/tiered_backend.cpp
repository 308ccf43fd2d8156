// One worker thread compiles first the wanted kernels in order, and then the expected kernels. An
// atomic pointer in each kernel switches it to native code.
#include "ir/tiered_backend.h"

#include "ir/interpreter.h"
#include "ir/kernel_cost.h"

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// Interpreting a row costs a fixed time, as much as interpreting this number of cells.
constexpr std::int64_t cells_per_row = 64;

/// The number by which one cell of this kernel counts towards `cells_worth_compiling`: 1 if the
/// kernel has no loops over links. An instruction inside a loop over links is compiled once but
/// runs for each link. It counts twice per link, because it gathers values from other cells.
std::int64_t weight_of(const CellKernel& kernel, Stencil stencil) {
    constexpr double links = 12;
    const double once = cost_of(kernel, stencil, 1).operations;
    const double whole = cost_of(kernel, stencil, 2 * links).operations;
    return std::max<std::int64_t>(1, std::llround(whole / std::max(once, 1.0)));
}

}  // namespace

/// The compiling thread and its queues.
class TieredBackend::Worker {
public:
    class TieredKernel;

    explicit Worker(Backend& native) : native_(native) {}

    /// Starts the thread if it does not run yet. Returns false if the thread cannot be started.
    bool start();
    /// Compiles the kernels that are wanted now, then ends the thread.
    void stop();
    void settle();
    void abandon();
    void add(const std::shared_ptr<TieredKernel>& kernel);
    void expect(const CellKernel& kernel, Stencil stencil);
    /// Tells the thread that more kernels are wanted. Allocates no memory, because computing
    /// threads call it.
    void wake();
    /// Waits until the kernel is compiled or refused, or until it is certain that it will never be
    /// compiled. Called by computing threads.
    void wait_for(const TieredKernel& kernel);

private:
    struct Source {
        CellKernel kernel;
        Stencil stencil;
    };

    void work();
    bool has_wanted() const;
    std::shared_ptr<TieredKernel> next_wanted();
    /// Whether the kernel is being compiled or waits for compilation.
    bool is_coming(const TieredKernel& kernel) const;

    Backend& native_;  ///< Used only by the thread, which ends before `native_` is destroyed.
    std::thread thread_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_stopping_ = false;
    /// Notified when a kernel is compiled or refused.
    std::condition_variable settled_;
    /// Kernels that wait for compilation, in the order of begin().
    std::vector<std::shared_ptr<TieredKernel>> begun_;
    const TieredKernel* in_work_ = nullptr;  ///< The wanted kernel that is being compiled, or null.
    std::deque<Source> expected_;
};

/// A kernel that is interpreted at first and runs native code later.
class TieredBackend::Worker::TieredKernel final : public Kernel {
public:
    TieredKernel(const CellKernel& kernel, Stencil stencil, KernelPointer interpreted,
                 std::weak_ptr<Worker> worker, bool is_wanted)
        : source_(std::make_unique<Source>(kernel, stencil)),
          weight_(weight_of(kernel, stencil)),
          interpreted_(std::move(interpreted)),
          worker_(std::move(worker)),
          present_(interpreted_.get()),
          is_wanted_(is_wanted) {}

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        run_present(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        run_present(arguments, cells);
    }
    bool is_provisional() const override { return !is_settled_.load(std::memory_order_acquire); }
    bool fills_columns() const override {
        return present_.load(std::memory_order_acquire)->fills_columns();
    }
    const Failure* refusal() const override {
        return !is_provisional() && refusal_ ? &*refusal_ : nullptr;
    }

    bool is_wanted() const { return is_wanted_.load(std::memory_order_relaxed); }

    /// Compiles the kernel. Called once, by the worker's thread.
    void compile(Backend& native) {
        try {
            auto made = native.compile(source_->kernel, source_->stencil);
            if (made) {
                native_ = std::move(*made);
                present_.store(native_.get(), std::memory_order_release);
            } else {
                refusal_ = std::move(made.error());
            }
        } catch (const std::bad_alloc&) {
            refusal_ = Failure{"there is not enough memory to compile it", ""};
        }
        source_.reset();
        is_settled_.store(true, std::memory_order_release);
    }

private:
    template <typename Number>
    void run_present(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const {
        if (is_provisional()) {
            const std::int64_t columns = cells.columns.within(arguments.layout.width).count();
            count((cells.rows.end - cells.rows.begin) * (columns * weight_ + cells_per_row));
        }
        present_.load(std::memory_order_acquire)->run(arguments, cells);
    }

    /// Counts `cells` cells that are about to be interpreted. Once enough cells have been
    /// interpreted, requests the kernel's compilation or waits for it.
    void count(std::int64_t cells) const {
        const std::int64_t before = interpreted_cells_.fetch_add(cells, std::memory_order_relaxed);
        if (before + cells < cells_worth_compiling) return;
        const auto worker = worker_.lock();
        if (!worker) return;
        if (is_wanted_.exchange(true)) return worker->wait_for(*this);
        interpreted_cells_.store(0, std::memory_order_relaxed);
        worker->wake();
    }

    std::unique_ptr<Source> source_;  ///< What to compile. Null once the kernel is compiled.
    std::int64_t weight_;
    KernelPointer interpreted_, native_;
    std::optional<Failure> refusal_;
    std::weak_ptr<Worker> worker_;
    std::atomic<const Kernel*> present_;
    std::atomic<bool> is_settled_{false};  ///< Whether the kernel is compiled or refused.
    mutable std::atomic<bool> is_wanted_;
    mutable std::atomic<std::int64_t> interpreted_cells_{0};
};

bool TieredBackend::Worker::start() {
    const std::lock_guard lock(mutex_);
    if (thread_.joinable()) return true;
    try {
        thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {
        return false;
    }
    return true;
}

void TieredBackend::Worker::stop() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
        expected_.clear();
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
    abandon();
}

void TieredBackend::Worker::settle() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [this] { return in_work_ == nullptr && !has_wanted(); });
}

bool TieredBackend::Worker::has_wanted() const {
    return std::any_of(begun_.begin(), begun_.end(),
                       [](const auto& kernel) { return kernel->is_wanted(); });
}

void TieredBackend::Worker::abandon() {
    std::vector<std::shared_ptr<TieredKernel>> kernels;  // Destroyed after the lock is released.
    {
        const std::lock_guard lock(mutex_);
        kernels.swap(begun_);
        expected_.clear();
    }
    settled_.notify_all();
}

void TieredBackend::Worker::add(const std::shared_ptr<TieredKernel>& kernel) {
    {
        const std::lock_guard lock(mutex_);
        // Drops kernels that no other object refers to and that have hardly been used.
        std::erase_if(begun_, [](const auto& known) {
            return known.use_count() == 1 && !known->is_wanted();
        });
        begun_.push_back(kernel);
    }
    changed_.notify_all();
}

void TieredBackend::Worker::expect(const CellKernel& kernel, Stencil stencil) {
    {
        const std::lock_guard lock(mutex_);
        expected_.push_back({kernel, stencil});
    }
    changed_.notify_all();
}

void TieredBackend::Worker::wake() {
    // Taking the lock once ensures that the thread is either about to check for wanted kernels or
    // already waiting, so the signal cannot be lost.
    { const std::lock_guard lock(mutex_); }
    changed_.notify_all();
}

void TieredBackend::Worker::wait_for(const TieredKernel& kernel) {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [&] { return !is_coming(kernel); });
}

bool TieredBackend::Worker::is_coming(const TieredKernel& kernel) const {
    return in_work_ == &kernel || std::any_of(begun_.begin(), begun_.end(), [&](const auto& begun) {
               return begun.get() == &kernel;
           });
}

std::shared_ptr<TieredBackend::Worker::TieredKernel> TieredBackend::Worker::next_wanted() {
    const auto found = std::find_if(begun_.begin(), begun_.end(),
                                    [](const auto& kernel) { return kernel->is_wanted(); });
    if (found == begun_.end()) return nullptr;
    auto kernel = std::move(*found);
    begun_.erase(found);
    return kernel;
}

void TieredBackend::Worker::work() {
    // A thread inherits its creator's floating-point environment, but compilers expect the default
    // one.
    std::fesetenv(FE_DFL_ENV);
    std::unique_lock lock(mutex_);
    while (true) {
        if (auto kernel = next_wanted()) {
            in_work_ = kernel.get();
            lock.unlock();
            kernel->compile(native_);
            // Dropping the reference may destroy the kernel, so it happens while the lock is not
            // held.
            kernel.reset();
            lock.lock();
            in_work_ = nullptr;
            settled_.notify_all();
        } else if (!expected_.empty()) {
            const Source source = std::move(expected_.front());
            expected_.pop_front();
            lock.unlock();
            try {
                // The result is not needed: a kernel that is refused now is refused again when it
                // is requested.
                (void)native_.compile(source.kernel, source.stencil);
            } catch (const std::bad_alloc&) {
            }
            lock.lock();
        } else if (is_stopping_) {
            return;
        } else {
            changed_.wait(lock);
        }
    }
}

TieredBackend::TieredBackend(std::unique_ptr<Backend> native)
    : native_(std::move(native)),
      interpreter_(make_interpreter()),
      worker_(std::make_shared<Worker>(*native_)) {}

TieredBackend::~TieredBackend() { worker_->stop(); }

std::string_view TieredBackend::name() const { return native_->name(); }

Result<KernelPointer> TieredBackend::compile(const CellKernel& kernel, Stencil stencil) {
    return native_->compile(kernel, stencil);
}

KernelPointer TieredBackend::find(const CellKernel& kernel, Stencil stencil) {
    return native_->find(kernel, stencil);
}

KernelCounts TieredBackend::counts() const { return native_->counts(); }

std::string TieredBackend::code_identity() const { return native_->code_identity(); }

KernelPointer TieredBackend::begin(const CellKernel& kernel, Stencil stencil, When when) {
    if (auto found = native_->find(kernel, stencil)) return found;
    KernelPointer interpreted = *interpreter_->compile(kernel, stencil);
    auto begun = std::make_shared<Worker::TieredKernel>(kernel, stencil, std::move(interpreted),
                                                        worker_, when == When::now);
    if (worker_->start()) {
        worker_->add(begun);
    } else {
        begun->compile(*native_);
    }
    return begun;
}

void TieredBackend::settle() { worker_->settle(); }

void TieredBackend::abandon() { worker_->abandon(); }

void TieredBackend::expect(const CellKernel& kernel, Stencil stencil) {
    if (!native_->find(kernel, stencil) && worker_->start()) worker_->expect(kernel, stencil);
}

}  // namespace cascade
