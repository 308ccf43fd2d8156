// Several threads take runs, each of which uses a single thread. All runs share a compiler. Each
// result is written as soon as its run ends, so that a later sweep can reuse it. If ranks share the
// sweep, the thread that has called sweep() exchanges messages while the others take runs.
#include "run/commands/sweep.h"

#include "core/hash.h"
#include "core/parallel.h"
#include "run/commands/sweep_data.h"
#include "run/commands/sweep_folder.h"
#include "run/commands/sweep_plan.h"
#include "run/commands/sweep_queue.h"
#include "run/commands/sweep_run.h"
#include "run/domain/free_memory.h"
#include "run/script/embedded_script.h"
#include "run/stage/memory.h"
#include "run/stage/time_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <span>
#include <system_error>
#include <thread>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_reports = std::chrono::milliseconds(100);
constexpr auto between_messages = std::chrono::milliseconds(1);

class Sweeper {
public:
    Sweeper(const Script& script, const SweepRequest& request, SweepControl& control)
        : script_(script), request_(request), control_(control) {}

    tl::expected<SweepReport, SweepError> run();

private:
    Result<std::vector<std::size_t>> find_waiting();
    Result<std::size_t> agree(std::size_t waiting);
    Result<void> choose_workers(std::size_t waiting);
    void run_all();
    void work(RunControl& control);
    void take(std::size_t number, RunControl& control);
    void watch();
    void tend();
    void report();
    void keep(std::size_t number, SweepResult result);
    void give_up(SweepError why);
    tl::expected<SweepReport, SweepError> finish();

    bool is_root() const {
        return request_.messenger == nullptr || request_.messenger->rank() == 0;
    }

    const Script& script_;
    const SweepRequest& request_;
    SweepControl& control_;
    std::filesystem::path folder_;
    /// The options of every run: a single thread, and the compiler that all runs share.
    SimulationOptions simulation_;
    SweepPlan plan_;
    std::vector<std::optional<SweepResult>> results_;
    std::unique_ptr<SweepData> data_;  ///< Null without --data, and on all ranks but rank 0.
    std::size_t waiting_runs_ = 0;     ///< The number of runs to take, on all ranks together.
    int workers_ = 1;
    SweepReport report_;
    Clock::time_point begun_, reported_;
    std::unique_ptr<SweepQueue> queue_;
    std::vector<std::unique_ptr<RunControl>> controls_;  ///< One for each thread.
    /// Whether no thread could be created. The thread of the caller then takes the runs.
    bool is_alone_ = false;

    std::mutex mutex_;  ///< Protects the members below, and `results_` during the runs.
    std::condition_variable changed_;
    std::size_t working_ = 0;
    double shares_done_ = 0;  ///< The sum of the finished fractions (0 … 1) of all runs.
    std::optional<SweepError> stopped_by_;
};

/// Chooses the largest number of concurrent runs that the threads and the free memory allow.
Result<void> Sweeper::choose_workers(std::size_t waiting) {
    const int threads =
        request_.simulation.threads > 0 ? request_.simulation.threads : hardware_threads();
    workers_ = std::min<int>(threads, static_cast<int>(waiting));
    double memory = static_cast<double>(available_memory()) / request_.ranks_here;
    if (request_.simulation.memory_limit > 0) {
        const auto limit = static_cast<double>(request_.simulation.memory_limit);
        memory = memory > 0 ? std::min(memory, limit) : limit;
    }
    if (memory > 0 && plan_.memory_of_a_run > 0) {
        // If memory is too small for even one run, that run will report the error.
        workers_ = std::max(1, std::min<int>(workers_, static_cast<int>(std::min(
                                                           1e6, memory / plan_.memory_of_a_run))));
    }
    simulation_ = request_.simulation;
    simulation_.threads = 1;
    if (!backend_named(simulation_.backend).is_native) return {};
    auto stepper = make_stepper(simulation_);
    if (!stepper) return tl::unexpected(stepper.error());
    simulation_.stepper = std::move(*stepper);
    return {};
}

void Sweeper::take(std::size_t number, RunControl& control) {
    auto result = take_run(script_, plan_.runs[number], request_, simulation_, folder_, control);
    if (!result) return give_up(std::move(result.error()));
    if (*result) keep(number, **std::move(result));
}

void Sweeper::keep(std::size_t number, SweepResult result) {
    if (!is_root()) return queue_->give(number, result);
    if (auto written = write_result(folder_ / "runs", plan_.runs[number].key, result); !written) {
        return give_up({written.error()});
    }
    const auto added = [&]() -> Result<void> {
        const std::lock_guard lock(mutex_);
        report_.steps += result.steps;
        results_[number] = std::move(result);
        return data_ ? data_->add_done(results_) : Result<void>();
    }();
    if (!added) give_up({added.error()});
}

/// Ends the sweep with an error that would stop every run, such as a full disk.
void Sweeper::give_up(SweepError why) {
    const std::lock_guard lock(mutex_);
    if (!stopped_by_) stopped_by_ = std::move(why);
    control_.cancel = true;
}

void Sweeper::work(RunControl& control) {
    double counted = 0;  // The fraction of this run that `shares_done_` already includes.
    control.report = [&](const Progress& progress) {
        const double stage = progress.steps > 0 ? static_cast<double>(progress.step) /
                                                      static_cast<double>(progress.steps)
                                                : 1;
        const double share = (progress.stage_number - 1 + stage) / progress.stage_count;
        {
            const std::lock_guard lock(mutex_);
            shares_done_ += share - counted;
            counted = share;
        }
        if (is_alone_) tend();
    };
    while (!control_.cancel) {
        const auto number = queue_->next(is_alone_);
        if (!number) break;
        counted = 0;
        take(*number, control);
        const std::lock_guard lock(mutex_);
        shares_done_ += 1 - counted;
    }
    const std::lock_guard lock(mutex_);
    --working_;
    changed_.notify_all();
}

/// Waits until the threads of this process have ended, and then until the other ranks have ended.
/// Called in the caller's thread.
void Sweeper::watch() {
    const std::chrono::milliseconds pause = request_.messenger ? between_messages : between_reports;
    std::unique_lock lock(mutex_);
    while (working_ > 0) {
        changed_.wait_for(lock, pause);
        lock.unlock();
        tend();
        lock.lock();
    }
    lock.unlock();
    // If a rank other than rank 0 has an error, it does not wait, because its error ends all ranks.
    while (!(stopped_by_ && !is_root()) && !queue_->has_finished()) {
        std::this_thread::sleep_for(pause);
        tend();
    }
}

/// Exchanges messages with other ranks, cancels all runs if the sweep is cancelled, and reports
/// progress. Called in the caller's thread.
void Sweeper::tend() {
    for (auto& [number, result] : queue_->serve()) {
        keep(number, std::move(result));
        const std::lock_guard lock(mutex_);
        shares_done_ += 1;
    }
    if (queue_->is_cancelled()) control_.cancel = true;
    if (control_.cancel) {
        queue_->cancel();
        for (auto& control : controls_) control->cancel = true;
    }
    if (Clock::now() - reported_ < between_reports) return;
    reported_ = Clock::now();
    report();
}

void Sweeper::report() {
    if (!control_.report) return;
    SweepProgress progress;
    progress.runs = plan_.own.size();
    {
        const std::lock_guard lock(mutex_);
        for (const auto& result : results_) progress.runs_done += result ? 1 : 0;
        progress.share = waiting_runs_ > 0 ? shares_done_ / static_cast<double>(waiting_runs_) : 1;
    }
    const double elapsed = seconds_since(begun_);
    if (progress.share > 0.001) {
        progress.seconds_left = elapsed * (1 - progress.share) / progress.share;
    }
    control_.report(progress);
}

void Sweeper::run_all() {
    begun_ = Clock::now();
    working_ = static_cast<std::size_t>(workers_);
    for (int w = 0; w < workers_; ++w) controls_.push_back(std::make_unique<RunControl>());
    std::vector<std::thread> threads;
    for (int w = 0; w < workers_; ++w) {
        try {
            RunControl& control = *controls_[static_cast<std::size_t>(w)];
            threads.emplace_back([&] { work(control); });
        } catch (const std::system_error&) {
            // No further thread can be created, so the existing threads take all runs. If there are
            // none, this thread takes the runs.
            const std::lock_guard lock(mutex_);
            working_ -= static_cast<std::size_t>(workers_ - std::max(w, 1));
            break;
        }
    }
    if (threads.empty()) {
        is_alone_ = true;
        work(*controls_[0]);
    }
    watch();
    for (std::thread& thread : threads) thread.join();
    report_.seconds = seconds_since(begun_);
}

/// Finds the runs of the part that have no result yet. Returns none on ranks other than rank 0,
/// which receive their runs from rank 0.
Result<std::vector<std::size_t>> Sweeper::find_waiting() {
    std::vector<std::size_t> waiting;
    if (!is_root()) return waiting;
    if (auto good = check_sweep_film(request_, control_.cancel); !good) {
        return tl::unexpected(good.error());
    }
    if (auto ready = prepare_folder(folder_); !ready) return tl::unexpected(ready.error());
    for (const std::size_t number : plan_.own) {
        auto result = earlier_result(request_, folder_, plan_.runs[number]);
        if (!result) return tl::unexpected(result.error());
        if (!*result) waiting.push_back(number);
        results_[number] = *std::move(result);
    }
    if (request_.data.empty()) return waiting;
    data_ = std::make_unique<SweepData>(script_, request_, plan_, folder_);
    if (auto added = data_->add_done(results_); !added) return tl::unexpected(added.error());
    return waiting;
}

/// Returns the number of runs to take, on all ranks together. Fails if this rank has planned other
/// runs than rank 0, because its script, files or options differ.
Result<std::size_t> Sweeper::agree(std::size_t waiting) {
    if (request_.messenger == nullptr) return waiting;
    std::uint64_t keys = plan_.runs.size();
    for (const PlannedRun& run : plan_.runs) keys = fnv1a(run.key, keys);
    std::array<std::uint64_t, 2> words = {keys, waiting};
    request_.messenger->broadcast(std::as_writable_bytes(std::span(words)));
    if (words[0] != keys) {
        return failure("this rank and rank 0 do not have the same runs",
                       "all ranks need the same script, options and files");
    }
    // Waits for all ranks, so that no run begins if one of them fails.
    std::vector<std::byte> arrived(static_cast<std::size_t>(request_.messenger->count()));
    std::vector<std::span<std::byte>> blocks;
    for (std::byte& each : arrived) blocks.emplace_back(&each, 1);
    request_.messenger->complete(blocks);
    return static_cast<std::size_t>(words[1]);
}

tl::expected<SweepReport, SweepError> Sweeper::run() {
    const auto failed = [](const Failure& why) { return tl::unexpected(SweepError{why}); };
    auto plan = plan_sweep(script_, request_);
    if (!plan) return tl::unexpected(std::move(plan.error()));
    plan_ = *std::move(plan);
    results_.resize(plan_.runs.size());
    report_.runs = plan_.own.size();
    folder_ = request_.folder;
    if (folder_.empty()) folder_ = output_stem(script_) + "_sweep";
    auto waiting = find_waiting();
    if (!waiting) return failed(waiting.error());
    report_.done_before = report_.runs - waiting->size();
    const auto count = agree(waiting->size());
    if (!count) return failed(count.error());
    waiting_runs_ = *count;
    queue_ = std::make_unique<SweepQueue>(*std::move(waiting), request_.messenger);
    if (auto chosen = choose_workers(waiting_runs_); !chosen) return failed(chosen.error());
    if (waiting_runs_ > 0) run_all();
    return finish();
}

/// Counts the results and writes the table and the sheet.
tl::expected<SweepReport, SweepError> Sweeper::finish() {
    if (!is_root()) {
        if (stopped_by_) return tl::unexpected(std::move(*stopped_by_));
        return SweepReport();
    }
    for (const std::size_t number : plan_.own) {
        const auto& result = results_[number];
        if (!result) ++report_.missing;
        if (!result || !result->failed()) continue;
        ++report_.failed;
        if (report_.first_failure.empty()) report_.first_failure = result->remark;
    }
    if (request_.part.is_all()) {
        auto written = write_sweep(script_, request_, folder_, results_, control_.cancel);
        if (!written) return tl::unexpected(SweepError{written.error()});
        report_.written = *std::move(written);
        if (data_ && !stopped_by_) {
            auto completed = data_->finish(results_);
            if (!completed) return tl::unexpected(SweepError{completed.error()});
            if (*completed) report_.written.push_back(request_.data);
        }
    }
    if (stopped_by_) return tl::unexpected(std::move(*stopped_by_));
    return std::move(report_);
}

}  // namespace

tl::expected<SweepReport, SweepError> sweep(const Script& script, const SweepRequest& request,
                                            SweepControl& control) {
    return Sweeper(script, request, control).run();
}

}  // namespace cascade
