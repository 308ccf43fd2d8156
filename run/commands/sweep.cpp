// Several threads take runs, each of which uses a single thread. All runs share a compiler. Each
// result is written as soon as its run ends, so that a later sweep can reuse it.
#include "run/commands/sweep.h"

#include "core/file.h"
#include "core/parallel.h"
#include "core/temporary_file.h"
#include "run/commands/run.h"
#include "run/commands/sweep_plan.h"
#include "run/domain/free_memory.h"
#include "run/pictures/measured.h"
#include "run/pictures/picture_remarks.h"
#include "run/script/embedded_script.h"
#include "run/simulation/end_remarks.h"
#include "run/stage/memory.h"
#include "run/stage/time_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_reports = std::chrono::milliseconds(100);

/// Joins the lines of a text, so that it fits into a cell of the table.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void add_remark(SweepResult& result, const std::string& words) {
    if (words.empty()) return;
    result.remark += (result.remark.empty() ? "" : "; ") + one_line(words);
}

class Sweeper {
public:
    Sweeper(const Script& script, const SweepRequest& request, SweepControl& control)
        : script_(script), request_(request), control_(control) {}

    tl::expected<SweepReport, SweepError> run();

private:
    Result<void> prepare_folders();
    Result<std::optional<SweepResult>> gather(const std::string& key);
    Result<bool> is_done(std::size_t number);
    Result<void> choose_workers(const std::vector<std::size_t>& waiting);
    void run_all(const std::vector<std::size_t>& waiting);
    void work(const std::vector<std::size_t>& waiting, RunControl& control);
    void take(std::size_t number, RunControl& control);
    Result<void> run_stages(Script& script, Simulation& simulation, RunControl& control,
                            SweepResult& result);
    void watch(std::vector<std::unique_ptr<RunControl>>& controls);
    void report();
    void keep(std::size_t number, SweepResult result);
    void give_up(SweepError why);

    const Script& script_;
    const SweepRequest& request_;
    SweepControl& control_;
    std::filesystem::path folder_;
    /// The options of every run, with one thread and the shared compiler.
    SimulationOptions simulation_;
    SweepPlan plan_;
    std::vector<std::optional<SweepResult>> results_;
    double waiting_runs_ = 0;  ///< The number of runs to take.
    int workers_ = 1;
    SweepReport report_;
    Clock::time_point begun_;
    /// Whether no thread could be created. The caller's thread then takes the runs.
    bool is_alone_ = false;

    std::mutex mutex_;  ///< Protects the members below, and `results_` during the runs.
    std::condition_variable changed_;
    std::size_t next_ = 0;
    std::size_t working_ = 0;
    double shares_done_ = 0;  ///< The sum over all runs of the finished fraction of each, 0 … 1.
    std::optional<SweepError> stopped_by_;
};

Result<void> Sweeper::prepare_folders() {
    if (auto good = check_sweep_film(request_, control_.cancel); !good) return good;
    folder_ = request_.folder;
    if (folder_.empty()) folder_ = output_stem(script_) + "_sweep";
    if (auto made = make_folder(folder_ / "runs"); !made) return made;
    for (const char* name : {"sheet.png", "features.csv", "runs/x.json"}) {
        if (auto good = check_writable(folder_ / name); !good) return good;
    }
    for (const auto& folder : {folder_, folder_ / "runs"}) remove_dead_temporaries(folder);
    return {};
}

/// Copies the result of a run from another sweep. Returns nothing if no sweep has it.
Result<std::optional<SweepResult>> Sweeper::gather(const std::string& key) {
    for (const auto& folder : request_.gathered) {
        auto result = read_result(folder / "runs", key);
        if (!result) continue;
        if (auto written = write_result(folder_ / "runs", key, *result); !written) {
            return tl::unexpected(written.error());
        }
        return result;
    }
    return std::optional<SweepResult>();
}

/// Uses the result of an earlier sweep for a run. Returns false if there is none.
Result<bool> Sweeper::is_done(std::size_t number) {
    if (request_.force) return false;
    const std::string& key = plan_.runs[number].key;
    auto result = read_result(folder_ / "runs", key);
    if (!result) {
        auto gathered = gather(key);
        if (!gathered) return tl::unexpected(gathered.error());
        result = *std::move(gathered);
    }
    if (!result) return false;
    const auto saved =
        folder_ / "fields" / folder_name(request_.varied, plan_.runs[number].values) / "run.json";
    std::error_code error;
    const bool has_fields = result->failed() || std::filesystem::exists(saved, error);
    if (request_.fields && !has_fields) return false;
    results_[number] = std::move(*result);
    return true;
}

/// Chooses the number of concurrent runs, as far as the threads and the free memory allow.
Result<void> Sweeper::choose_workers(const std::vector<std::size_t>& waiting) {
    const int threads =
        request_.simulation.threads > 0 ? request_.simulation.threads : hardware_threads();
    workers_ = std::min<int>(threads, static_cast<int>(waiting.size()));
    double memory = static_cast<double>(available_memory());
    if (request_.simulation.memory_limit > 0) {
        const auto limit = static_cast<double>(request_.simulation.memory_limit);
        memory = memory > 0 ? std::min(memory, limit) : limit;
    }
    if (memory > 0 && plan_.memory_of_a_run > 0) {
        // If memory is too small for even a single run, that run reports the error.
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

Result<void> Sweeper::run_stages(Script& script, Simulation& simulation, RunControl& control,
                                 SweepResult& result) {
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (auto started = simulation.start_stage(k, control.cancel); !started) {
            return control.cancel ? Result<void>() : started;
        }
        auto end = simulation.advance_stage(k, script.program->stages[k].iterations, control, {});
        result.steps += simulation.state(k).steps;
        if (!end) return tl::unexpected(end.error());
        if (*end == StageEnd::cancelled) return {};
        add_remark(result, remark_on(simulation, k));
    }
    return {};
}

void Sweeper::take(std::size_t number, RunControl& control) {
    const PlannedRun& run = plan_.runs[number];
    Script script = load(script_, run);
    auto painter = Painter::create(script, request_.picture);
    auto simulation = Simulation::create(script, simulation_);
    if (!painter) return give_up({painter.error()});
    if (!simulation) {
        const Failure why = simulation.error();
        // Errors in files that a script reads are reported at their names in the script.
        if (!script.diagnostics.has_errors()) return give_up({why});
        return give_up({why, std::move(script)});
    }
    SweepResult result;
    control.warn = [&](const std::string& warning) { add_remark(result, warning); };
    const auto done = run_stages(script, **simulation, control, result);
    control.warn = {};
    if (control.cancel) return;
    if (!done) {
        result.remark = one_line(done.error().message);
        return keep(number, std::move(result));
    }
    Canvas canvas = painter->canvas(**simulation);
    add_remark(result, remark_on_picture(*painter, **simulation, canvas));
    result.features = measure_shown(*painter, **simulation);
    result.cells = counts_of_cells((*simulation)->state(shown_stage(**simulation)));
    // Crawling cells have no rows and columns to be averaged, so their tile is a picture.
    painter->set_width(request_.tile_side);
    if (canvas.cells || (*simulation)->domain().model) canvas = canvas_of(painter->image(canvas));
    result.tile = shrink(canvas, request_.tile_side);
    if (request_.fields) {
        const auto folder = folder_ / "fields" / folder_name(request_.varied, run.values);
        if (auto saved = save_run(folder, script, **simulation); !saved) {
            return give_up({saved.error()});
        }
    }
    keep(number, std::move(result));
}

void Sweeper::keep(std::size_t number, SweepResult result) {
    if (auto written = write_result(folder_ / "runs", plan_.runs[number].key, result); !written) {
        return give_up({written.error()});
    }
    const std::lock_guard lock(mutex_);
    report_.steps += result.steps;
    results_[number] = std::move(result);
}

/// Ends the sweep with an error that would stop every run, such as a full disk.
void Sweeper::give_up(SweepError why) {
    const std::lock_guard lock(mutex_);
    if (!stopped_by_) stopped_by_ = std::move(why);
    control_.cancel = true;
}

void Sweeper::work(const std::vector<std::size_t>& waiting, RunControl& control) {
    double counted = 0;  // The fraction of this run that is already included in `shares_done_`.
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
        if (!is_alone_) return;
        if (control_.cancel) control.cancel = true;
        report();
    };
    while (true) {
        std::size_t number = 0;
        {
            const std::lock_guard lock(mutex_);
            if (next_ == waiting.size() || control_.cancel) break;
            number = waiting[next_++];
        }
        counted = 0;
        take(number, control);
        const std::lock_guard lock(mutex_);
        shares_done_ += 1 - counted;
    }
    const std::lock_guard lock(mutex_);
    --working_;
    changed_.notify_all();
}

/// Tells all runs of a cancel, and reports progress. Called in the caller's thread.
void Sweeper::watch(std::vector<std::unique_ptr<RunControl>>& controls) {
    std::unique_lock lock(mutex_);
    while (working_ > 0) {
        changed_.wait_for(lock, between_reports);
        if (control_.cancel) {
            for (auto& control : controls) control->cancel = true;
        }
        lock.unlock();
        report();
        lock.lock();
    }
}

void Sweeper::report() {
    if (!control_.report) return;
    SweepProgress progress;
    progress.runs = plan_.own.size();
    {
        const std::lock_guard lock(mutex_);
        for (const auto& result : results_) progress.runs_done += result ? 1 : 0;
        progress.share = waiting_runs_ > 0 ? shares_done_ / waiting_runs_ : 1;
    }
    const double elapsed = seconds_since(begun_);
    if (progress.share > 0.001) {
        progress.seconds_left = elapsed * (1 - progress.share) / progress.share;
    }
    control_.report(progress);
}

void Sweeper::run_all(const std::vector<std::size_t>& waiting) {
    if (waiting.empty()) return;
    begun_ = Clock::now();
    waiting_runs_ = static_cast<double>(waiting.size());
    working_ = static_cast<std::size_t>(workers_);
    std::vector<std::unique_ptr<RunControl>> controls;
    std::vector<std::thread> threads;
    for (int w = 0; w < workers_; ++w) {
        controls.push_back(std::make_unique<RunControl>());
        try {
            threads.emplace_back([&, control = controls.back().get()] { work(waiting, *control); });
        } catch (const std::system_error&) {
            // No more threads can be created. The existing threads take all runs. If there are
            // none, this thread takes them.
            const std::lock_guard lock(mutex_);
            working_ -= static_cast<std::size_t>(workers_ - std::max(w, 1));
            break;
        }
    }
    if (threads.empty()) {
        is_alone_ = true;
        work(waiting, *controls[0]);
    }
    watch(controls);
    for (std::thread& thread : threads) thread.join();
    report_.seconds = seconds_since(begun_);
}

tl::expected<SweepReport, SweepError> Sweeper::run() {
    const auto failed = [](const Failure& why) { return tl::unexpected(SweepError{why}); };
    auto plan = plan_sweep(script_, request_);
    if (!plan) return tl::unexpected(std::move(plan.error()));
    plan_ = *std::move(plan);
    results_.resize(plan_.runs.size());
    report_.runs = plan_.own.size();
    if (auto ready = prepare_folders(); !ready) return failed(ready.error());
    std::vector<std::size_t> waiting;
    for (const std::size_t number : plan_.own) {
        const auto done = is_done(number);
        if (!done) return failed(done.error());
        if (!*done) waiting.push_back(number);
    }
    report_.done_before = report_.runs - waiting.size();
    if (auto chosen = choose_workers(waiting); !chosen) return failed(chosen.error());
    run_all(waiting);
    for (const std::size_t number : plan_.own) {
        const auto& result = results_[number];
        if (!result) ++report_.missing;
        if (!result || !result->failed()) continue;
        ++report_.failed;
        if (report_.first_failure.empty()) report_.first_failure = result->remark;
    }
    if (request_.part.is_all()) {
        auto written = write_sweep(script_, request_, folder_, results_, control_.cancel);
        if (!written) return failed(written.error());
        report_.written = *std::move(written);
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
