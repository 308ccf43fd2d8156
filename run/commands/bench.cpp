// Takes increasing numbers of steps to warm up, and then measures the time of batches of whole
// tiles. The time of a step is the median over the batches. Crawling cells increase in number, so
// each of their steps is measured alone, and the time of a step is the mean. If a stage ends too
// soon, it is started again.
#include "run/commands/bench.h"

#include "ir/solver.h"
#include "lang/program/stage_kinds.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/stage_state.h"
#include "run/stage/stage_time.h"
#include "run/stage/time_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

class StageMeter {
public:
    StageMeter(Simulation& simulation, std::uint32_t stage, double seconds, RunControl& control,
               std::set<std::string>& said)
        : simulation_(simulation), k_(stage), seconds_(seconds), control_(control), said_(said) {
        watched_.report = [this](const Progress&) {
            if (control_.cancel) watched_.cancel = true;
        };
        watched_.warn = [this](const std::string& message) {
            // Each message is reported only once, even if the stage is started again.
            if (said_.insert(message).second && control_.warn) control_.warn(message);
        };
        last_step_ = simulation_.domain().stage(k_).iterations;
    }

    /// Takes the first step, and then enough steps to warm up caches and threads.
    Result<void> warm_up(StageBench& bench) {
        const auto begin = Clock::now();
        const auto first = advance(1, 1);
        if (!first) return tl::unexpected(first.error());
        bench.first_step = seconds_since(begin);
        const double enough = std::min(least_warm_up, seconds_);
        const auto warm = Clock::now();
        step_seconds_ = bench.first_step;
        for (std::int64_t count = 2; seconds_since(warm) < most_warm_up && !control_.cancel;
             count *= 4) {
            if (auto ready = begin_again_where_done(); !ready) return ready;
            const auto start = Clock::now();
            const auto taken = advance(count, count);
            if (!taken) return tl::unexpected(taken.error());
            const double spent = seconds_since(start);
            if (*taken > 0) step_seconds_ = spent / static_cast<double>(*taken);
            if (spent >= enough || *taken < count) break;
        }
        return {};
    }

    /// Measures the time of batches of whole tiles. A tile has `steps_of_tile` steps.
    Result<void> measure(StageBench& bench, std::int64_t steps_of_tile) {
        begin_ = Clock::now();
        const double batch = std::clamp(seconds_ / batches_wanted, 1e-4, 0.25);
        std::int64_t every =
            static_cast<std::int64_t>(std::clamp(batch / std::max(step_seconds_, 1e-9), 1.0, 1e9));
        if (cells()) every = 1;
        every = (every + steps_of_tile - 1) / steps_of_tile * steps_of_tile;
        while (!is_enough() && !control_.cancel) {
            if (auto ready = begin_again_where_done(); !ready) return ready;
            const std::size_t before = batches_.size();
            const auto start = Clock::now();
            const auto taken = advance(last_step_, every);
            if (!taken) return tl::unexpected(taken.error());
            if (*taken == 0) break;
            if (batches_.size() > before) continue;
            // A stage that is too short for batches is measured as a whole.
            if (every == 1) add_batch(seconds_since(start), *taken);
            every = std::max<std::int64_t>(1, std::min(every, *taken) / 4);
        }
        if (batches_.empty()) return {};
        bench.step = median(batches_);
        bench.batches = batches_.size();
        bench.steps = steps_;
        if (!cells()) return {};
        bench.step = measured_ / static_cast<double>(steps_);
        bench.mean_cells = std::max(1.0, cell_steps_ / static_cast<double>(steps_));
        return {};
    }

private:
    bool is_enough() const {
        if (measured_ >= seconds_ && batches_.size() >= least_batches) return true;
        // Computing starting values may take longer than all steps of a stage, and a step may take
        // longer than a batch. So the limit of the real time is longer than the requested time.
        return !batches_.empty() && seconds_since(begin_) > 4 * seconds_ + 1;
    }

    std::optional<CellCounts> cells() const { return counts_of_cells(simulation_.state(k_)); }

    void add_batch(double seconds, std::int64_t steps) {
        if (const auto crawling = cells())
            cell_steps_ += static_cast<double>(crawling->count) * static_cast<double>(steps);
        batches_.push_back(seconds / static_cast<double>(steps));
        measured_ += seconds;
        steps_ += steps;
    }

    Result<void> begin_again_where_done() {
        const StageState& state = simulation_.state(k_);
        if (state.steps < last_step_ && !state.done) return {};
        return simulation_.start_stage(k_);
    }

    /// Takes `count` steps, or fewer if the stage ends. Returns the number of steps taken.
    Result<std::int64_t> advance(std::int64_t count, std::int64_t every) {
        const std::int64_t before = simulation_.state(k_).steps;
        const std::int64_t last = count < last_step_ - before ? before + count : last_step_;
        std::optional<Clock::time_point> seen;
        std::int64_t seen_step = before;
        watched_.cancel = control_.cancel.load();
        const auto look = [&] {
            const auto now = Clock::now();
            const std::int64_t step = simulation_.state(k_).steps;
            // The first batch is not measured, because it also wakes the threads and reads the
            // planes into the caches.
            if (seen && step > seen_step) {
                add_batch(std::chrono::duration<double>(now - *seen).count(), step - seen_step);
            }
            seen = now;
            seen_step = step;
            if (control_.cancel || is_enough()) watched_.cancel = true;
        };
        const bool measures = count > every;
        auto end = simulation_.advance_stage(k_, last, watched_,
                                             measures ? std::function<void()>(look)
                                                      : std::function<void()>(),
                                             every);
        if (!end) return tl::unexpected(end.error());
        return simulation_.state(k_).steps - before;
    }

    static constexpr double least_warm_up = 0.03, most_warm_up = 1.0;
    static constexpr double batches_wanted = 11;
    static constexpr std::size_t least_batches = 5;

    Simulation& simulation_;
    std::uint32_t k_;
    double seconds_;
    RunControl& control_;
    /// Its `cancel` ends a batch of steps without cancelling the whole bench.
    RunControl watched_;
    std::set<std::string>& said_;
    std::int64_t last_step_ = 0;
    Clock::time_point begin_;
    double step_seconds_ = 0;
    std::vector<double> batches_;  ///< Seconds per step.
    double measured_ = 0;
    std::int64_t steps_ = 0;
    /// For crawling cells, the number of cells, summed over all measured steps.
    double cell_steps_ = 0;
};

class ScriptBench {
public:
    ScriptBench(Script& script, const BenchRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    Result<void> run(const std::function<void(const StageBench&)>& tell) {
        if (script_.program->stages.empty()) {
            script_.diagnostics.error({0, 0, 0}, "this script has no stage to measure",
                                      example_of_stage(*script_.program));
            return failure("nothing to measure");
        }
        std::optional<std::uint32_t> only;
        if (!request_.stage.empty()) {
            auto found = find_stage(*script_.program, request_.stage);
            if (!found) return tl::unexpected(found.error());
            only = *found;
        }
        // On coarser grids, stages would take steps before the steps on the full grid. Such steps
        // must not be measured.
        auto measured = std::make_shared<Program>(*script_.program);
        for (Stage& stage : measured->stages) stage.time.coarse = 1;
        script_.program = std::move(measured);
        SimulationOptions options = request_.simulation;
        options.account = &account_;
        options.control = &control_;
        options.starts_interpreted = false;  // The speed of compiled code is to be measured.
        auto made = Simulation::create(script_, options);
        if (!made) return control_.cancel ? Result<void>() : tl::unexpected(made.error());
        simulation_ = std::move(*made);
        const std::uint32_t last = only.value_or(script_.stage_count() - 1);
        for (std::uint32_t k = 0; k <= last && !control_.cancel; ++k) {
            if (auto started = simulation_->start_stage(k); !started) return started;
            if (only && k != *only) continue;
            auto stage = measure(k);
            if (!stage) return tl::unexpected(stage.error());
            if (!control_.cancel) tell(*stage);
        }
        return {};
    }

private:
    Result<StageBench> measure(std::uint32_t k) {
        const Stage& stage = script_.program->stages[k];
        StageBench bench;
        bench.stage = stage.name;
        bench.solver = name_of(stage.time.solver);
        bench.grid = simulation_->domain(k).grid;
        bench.precision = script_.program->domain.precision;
        bench.fast = script_.program->domain.fast;
        bench.is_native = backend_named(request_.simulation.backend).is_native;
        bench.most_threads =
            request_.simulation.threads > 0 ? request_.simulation.threads : hardware_threads();
        if (stage.iterations == 0 && !stage.time.has_duration()) {
            bench.nothing = "it takes no step";
            return bench;
        }
        bench.starting = spent(k, Spent::starting);
        StageMeter meter(*simulation_, k, request_.seconds, control_, said_);
        if (auto warm = meter.warm_up(bench); !warm) return tl::unexpected(warm.error());
        const bool has_cells = is_of_cells(*script_.program, k);
        if (!control_.cancel && !has_cells && account_.stage(k).steps == 0) {
            bench.nothing = "nothing moves in it";
            return bench;
        }
        bench.compiling = account_.seconds(Spent::compiling) - compiled_;
        compiled_ = account_.seconds(Spent::compiling);
        const double at_once = std::ceil(account_.stage(k).stepping.sweeps_at_once);
        if (auto done = meter.measure(bench, static_cast<std::int64_t>(at_once)); !done) {
            return tl::unexpected(done.error());
        }
        if (control_.cancel) return bench;
        if (bench.step <= 0) {
            bench.nothing = "it ends before it takes a step";
            return bench;
        }
        if (has_cells) {
            bench.threads = bench.most_threads;
            return bench;
        }
        bench.threads = account_.stage(k).threads;
        bench.stepping = account_.stage(k).stepping;
        bench.work = step_work(*simulation_, k);
        if (account_.stage(k).has_refused) {
            // If the steps could not be compiled, the kernels that measure the machine cannot be
            // compiled, either.
            bench.is_native = false;
            return bench;
        }
        if (auto known = find_limits(bench); !known) return tl::unexpected(known.error());
        return bench;
    }

    double spent(std::uint32_t k, Spent what) {
        account_.seconds();  // Adds the time up to now to the account.
        return account_.stage(k).seconds[static_cast<std::size_t>(what)];
    }

    /// Measures the machine with as many threads as the stage used. Each number of threads is
    /// measured only once.
    Result<void> find_limits(StageBench& bench) {
        if (!request_.has_limits || !fastest_backend().is_native) return {};
        auto& known = limits_[bench.threads];
        if (!known) {
            SimulationOptions native = request_.simulation;
            native.backend = fastest_backend().name;
            auto backend = make_stepper(native);
            if (!backend) return tl::unexpected(backend.error());
            auto measured =
                measure_limits(**backend, bench.precision, bench.threads, control_.cancel);
            if (!measured && control_.cancel) return {};
            if (!measured) return tl::unexpected(measured.error());
            known = std::move(*measured);
        }
        bench.limits = known;
        return {};
    }

    Script& script_;
    const BenchRequest& request_;
    RunControl& control_;
    TimeAccount account_;
    std::unique_ptr<Simulation> simulation_;
    double compiled_ = 0;  ///< Seconds spent on compiling so far.
    /// The limits that were measured with each number of threads.
    std::map<int, std::optional<MachineLimits>> limits_;
    std::set<std::string> said_;
};

}  // namespace

Result<void> bench(Script& script, const BenchRequest& request, RunControl& control,
                   const std::function<void(const StageBench&)>& tell) {
    return ScriptBench(script, request, control).run(tell);
}

}  // namespace cascade
