// Runs the passes of steps on threads, several passes together if tiles save memory traffic. Every
// thread runs all passes on its own rows. Before a pass that reads rows of other threads, the
// threads wait for each other.
#include "core/check.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "solvers/executor.h"
#include "solvers/field_norms.h"
#include "solvers/finite.h"
#include "solvers/pass_runner.h"
#include "solvers/step_planes.h"
#include "solvers/tile_runner.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>

namespace cascade {
namespace {

StepMoment moment_of(std::int64_t complete, const StageClock& clock,
                     const std::atomic<bool>* cancel) {
    return {complete, clock.at(complete), clock.step, clock.at(complete + 1), cancel};
}

void go_on(StepPass& next, std::size_t passes) {
    if (++next.pass < passes) return;
    next.pass = 0;
    ++next.complete;
    next.roles.go_on();
}

class ThreadExecutor final : public Executor {
public:
    ThreadExecutor(const StepProblem& problem, std::vector<Field> species, int most_threads,
                   bool keeps, Exchange* others);

    const StepProblem& problem() const override { return *problem_; }
    void prepare(const StepProblem& problem) override;

    const std::vector<Field>& fetch(int copy) override { return planes_.copy(copy); }
    const std::vector<Field>& fetch(RegisterId id) override { return planes_.scratch(id); }
    std::vector<Field> take(int copy) override { return planes_.take(copy); }
    void put(int copy, std::vector<Field> species) override {
        planes_.put(copy, std::move(species));
    }
    void exchange(RegisterId one, RegisterId other) override { planes_.exchange(one, other); }
    void fill_halos(int copy, SideMoment moment) override {
        const FlushDenormals environment;
        if (others_ == nullptr) return problem_->fill_halos(planes_.copy(copy), moment);
        runner_->fill_sides(planes_.copy(copy), moment);
        are_halos_shared_ = levels_of_halo_ == 1;
        if (are_halos_shared_) runner_->share_species(planes_.copy(copy));
    }

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override;
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override;
    bool is_finite(int copy) override;

    int most_threads() const override { return team_.size(); }
    void use_threads(int threads) override;
    std::vector<Tiling> tilings_to_try() const override {
        if (others_ != nullptr) return {best_tiling()};
        return cascade::tilings_to_try(*problem_, reach_, CacheSizes::here(), most_threads());
    }
    void use_tiling(const Tiling& tiling) override;
    int levels() const override { return std::max(tiles_->levels(), levels_of_halo_); }
    Stepping stepping() const override {
        return stepping_with(*problem_, tiling_, tiles_->levels(), tiles_->phases());
    }

private:
    /// The work of a thread on its share of the cells.
    using OwnCells = std::function<void(int thread, const Patch& cells)>;
    struct Worker {
        PassRunner::Worker passes;
        std::vector<std::span<Field>> registers;
    };
    /// The arguments of a run that are the same for all threads.
    struct Given {
        const StageClock& clock;
        const std::atomic<bool>* cancel = nullptr;
        const RowsWritten* written_by_last = nullptr;  ///< For the last pass; may be null.
    };
    /// Sums of squares, one per row.
    struct Squares {
        std::vector<double> of_errors, of_values;
    };

    Tiling best_tiling() const;
    void set_tiling(const Tiling& tiling);
    void run(const Given& given, const StepPass& first, std::size_t count, const OwnCells& after);
    void run_passes(Worker& worker, const Given& given, StepPass next, std::size_t left,
                    bool meets);
    void run_tiles(Worker& worker, const Given& given, StepPass& next, std::size_t count,
                   bool meets);
    std::size_t passes_together(const StepPass& next, std::size_t left, int most) const;
    void run_together(Worker& worker, const Given& given, StepPass& next, std::size_t count,
                      std::size_t followers);
    void share_reads(Worker& worker, StepPass next, std::size_t count, bool one_by_one);
    OwnCells check_of(int copy);
    bool all_finite() const;
    void add_squares(RowRange rows, const std::vector<Field>& values);

    const StepProblem* problem_;
    Exchange* others_;  ///< Null if the planes hold the whole grid.
    StepPlanes planes_;
    Team team_;
    std::optional<PassRunner> runner_;
    std::int64_t reach_ = 1;  ///< The number of rows that links reach.
    int levels_of_halo_ = 1;  ///< The largest number of passes between two exchanges of halos.
    /// Whether halos have been exchanged after the last pass, which is so if passes run one by one.
    bool are_halos_shared_ = true;
    Tiling tiling_;
    bool is_tiling_given_ = false;
    std::optional<TileRunner> tiles_;
    std::vector<Worker> workers_;       ///< One for each thread in use.
    std::vector<Squares> squares_;      ///< One for each species.
    std::vector<std::uint8_t> finite_;  ///< Whether each thread's cells are finite.
};

ThreadExecutor::ThreadExecutor(const StepProblem& problem, std::vector<Field> species,
                               int most_threads, bool keeps, Exchange* others)
    : problem_(&problem),
      others_(others),
      planes_(layout_of(problem, others), problem.precision, std::move(species), keeps),
      team_(worthwhile_threads(problem.grid, planes_.copy(0).size(), most_threads)),
      runner_(std::in_place, problem, others),
      finite_(static_cast<std::size_t>(team_.size())) {
    planes_.make_registers(problem.registers);
    reach_ = rows_reached(problem);
    if (others != nullptr) levels_of_halo_ = others->levels();
    are_halos_shared_ = levels_of_halo_ == 1;
    tiling_ = best_tiling();
    use_threads(team_.size());
}

void ThreadExecutor::prepare(const StepProblem& problem) {
    if (&problem == problem_) return;
    CHECK(problem.grid == problem_->grid, "passes of one grid");
    problem_ = &problem;
    planes_.make_registers(problem.registers);
    runner_.emplace(problem, others_);
    CHECK(runner_->layout() == planes_.layout(), "all passes have planes of one layout");
    if (others_ != nullptr) {
        levels_of_halo_ = std::min(others_->levels(), levels_of_halo(problem, others_->parts(), 1));
    }
    for (Worker& worker : workers_) {
        runner_->prepare(worker.passes, worker.passes.number, worker.passes.count);
    }
    set_tiling(is_tiling_given_ ? tiling_ : best_tiling());
}

/// The tiling that fits the caches. In a part of a grid, it has several levels only if the halo is
/// wide enough.
Tiling ThreadExecutor::best_tiling() const {
    if (others_ == nullptr) return choose_tiling(*problem_, reach_, CacheSizes::here());
    if (levels_of_halo_ == 1) return {};
    Grid part = problem_->grid;
    const std::int64_t rows = planes_.layout().rows.count();
    (part.depth > 1 ? part.depth : part.height) = part.depth > 1 ? rows / part.height : rows;
    // The parts on one machine share its third-level cache. So tiles are made to fit into the
    // second-level cache, where possible.
    CacheSizes near = CacheSizes::here();
    near.third = 0;
    Tiling tiling = choose_tiling(*problem_, part, reach_, near);
    if (tiling.levels == 1) tiling = choose_tiling(*problem_, part, reach_, CacheSizes::here());
    return tiling.levels > 1 ? tiling : Tiling{};
}

void ThreadExecutor::use_threads(int threads) {
    if (static_cast<std::size_t>(threads) == workers_.size()) return;
    workers_.resize(static_cast<std::size_t>(threads));
    for (int index = 0; index < threads; ++index) {
        runner_->prepare(workers_[static_cast<std::size_t>(index)].passes, index, threads);
    }
    set_tiling(tiling_);
}

void ThreadExecutor::use_tiling(const Tiling& tiling) {
    if (levels_of_halo_ == 1 && others_ != nullptr) return;
    if (is_tiling_given_ && tiling == tiling_) return;
    is_tiling_given_ = true;
    set_tiling(tiling);
}

void ThreadExecutor::set_tiling(const Tiling& tiling) {
    tiling_ = tiling;
    Tiling reaching = tiling;
    if (problem_->grid.linked) reaching.outer_layer = std::max(reaching.outer_layer, reach_);
    tiles_.emplace(*runner_, reaching, static_cast<int>(workers_.size()));
}

bool ThreadExecutor::run(const StageClock& clock, StepPass first, std::size_t count, bool check,
                         const std::atomic<bool>* cancel) {
    if (!check) {
        run({clock, cancel}, first, count, nullptr);
        return true;
    }
    CopyRoles roles = first.roles;
    for (std::size_t step = 0; step < count / problem_->passes.size(); ++step) roles.go_on();
    run({clock, cancel}, first, count, check_of(roles.current));
    return all_finite();
}

std::vector<ErrorOfStep> ThreadExecutor::run_judged(const StageClock& clock, StepPass first,
                                                    const std::atomic<bool>* cancel) {
    const std::vector<Field>& values = planes_.copy(first.roles.target());
    squares_.resize(values.size());
    for (Squares& squares : squares_) {
        squares.of_errors.resize(static_cast<std::size_t>(planes_.layout().row_count()));
        squares.of_values.resize(squares.of_errors.size());
    }
    const RowsWritten written = [&](RowRange rows) { add_squares(rows, values); };
    run({clock, cancel, &written}, first, problem_->passes.size() - first.pass, nullptr);
    if (others_ != nullptr) {
        std::vector<std::vector<double>*> rows;
        for (Squares& squares : squares_) {
            rows.push_back(&squares.of_errors);
            rows.push_back(&squares.of_values);
        }
        others_->share_rows(rows);
    }
    const std::int64_t cells = problem_->counted_cells();
    std::vector<ErrorOfStep> errors;
    for (const Squares& squares : squares_) {
        errors.push_back({root_mean_square(squares.of_errors, cells),
                          root_mean_square(squares.of_values, cells)});
    }
    return errors;
}

bool ThreadExecutor::is_finite(int copy) {
    const OwnCells check = check_of(copy);
    team_.run(
        [&](int thread) { check(thread, workers_[static_cast<std::size_t>(thread)].passes.cells); },
        static_cast<int>(workers_.size()));
    return all_finite();
}

/// The function by which each thread checks its cells of a copy.
ThreadExecutor::OwnCells ThreadExecutor::check_of(int copy) {
    std::fill(finite_.begin(), finite_.end(), std::uint8_t{1});
    return [this, copy](int thread, const Patch& cells) {
        for (const Field& field : planes_.copy(copy)) {
            if (!are_finite(field, cells)) finite_[static_cast<std::size_t>(thread)] = 0;
        }
    };
}

bool ThreadExecutor::all_finite() const {
    return std::all_of(finite_.begin(), finite_.end(), [](std::uint8_t is) { return is != 0; });
}

/// Sums the squares of the errors and of the values in some rows of the step just computed.
void ThreadExecutor::add_squares(RowRange rows, const std::vector<Field>& values) {
    const std::vector<Field>& errors = planes_.scratch(*problem_->error_register);
    for (std::size_t k = 0; k < squares_.size(); ++k) {
        for (std::int64_t row = rows.begin; row < rows.end; ++row) {
            const auto place = static_cast<std::size_t>(row);
            const std::int64_t cells = problem_->counted_in_row(row);
            squares_[k].of_errors[place] = sum_of_squares(errors[k], row, cells);
            squares_[k].of_values[place] = sum_of_squares(values[k], row, cells);
        }
    }
}

void ThreadExecutor::run(const Given& given, const StepPass& first, std::size_t count,
                         const OwnCells& after) {
    team_.run(
        [&](int thread) {
            Worker& worker = workers_[static_cast<std::size_t>(thread)];
            run_passes(worker, given, first, count, after != nullptr);
            if (after) after(thread, worker.passes.cells);
        },
        static_cast<int>(workers_.size()));
    are_halos_shared_ = levels_of_halo_ == 1;
}

/// Runs `left` passes from `next` on. If `meets` is true, each thread's own cells are complete when
/// it returns. Parts exchange halos before each batch of passes.
void ThreadExecutor::run_passes(Worker& worker, const Given& given, StepPass next, std::size_t left,
                                bool meets) {
    if (others_ == nullptr) {
        run_tiles(worker, given, next, left, meets);
        left = 0;
    } else if (levels_of_halo_ == 1 && !are_halos_shared_) {
        share_reads(worker, next, std::min(left, problem_->passes.size()), true);
    }
    while (left > 0) {
        const std::size_t batch = passes_together(next, left, levels_of_halo_), pass = next.pass;
        left -= batch;
        if (levels_of_halo_ > 1) share_reads(worker, next, batch, false);
        run_tiles(worker, given, next, batch, true);
        if (levels_of_halo_ > 1) continue;
        if (worker.passes.number == 0) runner_->share_results(pass, worker.registers);
        if (left > 0 || meets) team_.barrier();
    }
    if (given.written_by_last == nullptr || !tiles_->is_along_columns()) return;
    team_.barrier();
    (*given.written_by_last)(worker.passes.rows);
}

/// Runs `left` passes without an exchange of halos between them.
void ThreadExecutor::run_tiles(Worker& worker, const Given& given, StepPass& next, std::size_t left,
                               bool meets) {
    // One barrier after each tile is enough: after it, no thread reads the copy that the next pass
    // overwrites, and every thread has filled the halo cells that copy its own rows. With tiles or
    // columns, a thread's cells may have been computed by other threads.
    const bool is_elsewhere =
        tiles_->levels() > 1 || has_few_rows(problem_->grid) || others_ != nullptr;
    while (left > 0) {
        const std::size_t together = passes_together(next, left, tiles_->levels());
        left -= together;
        run_together(worker, given, next, together, left);
        if (left > 0 || (meets && is_elsewhere)) team_.barrier();
    }
}

/// Fills the halos that the next `count` passes read. If passes run `one_by_one`, halos need only
/// be wide enough for one pass. Before the call, all threads must have completed the last pass.
void ThreadExecutor::share_reads(Worker& worker, StepPass next, std::size_t count,
                                 bool one_by_one) {
    if (worker.passes.number == 0) {
        const auto levels = static_cast<std::int64_t>(one_by_one ? 1 : count);
        HaloReads reads(*problem_, levels);
        for (std::size_t number = 0; number < count; ++number) {
            if (number == 0 || next.pass == 0) planes_.list(next.roles, worker.registers);
            runner_->add_reads(next.pass, worker.registers, reads);
            go_on(next, problem_->passes.size());
            if (!one_by_one) continue;
            runner_->share_reads(reads);
            reads = HaloReads(*problem_, levels);
        }
        if (!one_by_one) runner_->share_reads(reads);
    }
    team_.barrier();
}

/// The number of passes to run together if `left` remain. Divides the passes up to the next pass
/// that needs all rows into groups of nearly equal size, with at most `limit` passes each.
std::size_t ThreadExecutor::passes_together(const StepPass& next, std::size_t left,
                                            int limit) const {
    const auto most = static_cast<std::size_t>(limit);
    const std::size_t passes = problem_->passes.size();
    std::size_t free = 1;
    while (free < left && !needs_all_rows(problem_->passes[(next.pass + free) % passes])) {
        if (++free > 2 * most) return most;
    }
    const std::size_t tiles = (free + most - 1) / most;
    return (free + tiles - 1) / tiles;
}

/// Runs `count` passes as one tile. `followers` more passes run before halos are exchanged.
void ThreadExecutor::run_together(Worker& worker, const Given& given, StepPass& next,
                                  std::size_t count, std::size_t followers) {
    const std::size_t passes = problem_->passes.size();
    for (std::size_t number = 0; number < count; ++number) {
        if (number == 0 || next.pass == 0) planes_.list(next.roles, worker.registers);
        const StepMoment moment = moment_of(next.complete, given.clock, given.cancel);
        if (number == 0) {
            runner_->prepare_pass(worker.passes, team_, next.pass, worker.registers, moment);
        }
        // The first pass of a tile brings the data of the other passes into the cache.
        const bool is_last = next.pass + 1 == passes;
        const auto left = static_cast<std::int64_t>(count - 1 - number + followers);
        runner_->bind(worker.passes, number, next.pass, worker.registers, moment,
                      {tiling_.is_near && number > 0,
                       is_last && !tiles_->is_along_columns() ? given.written_by_last : nullptr,
                       left});
        go_on(next, passes);
    }
    if (count == 1 && !tiles_->is_along_columns()) {
        runner_->run_share(worker.passes, 0);
    } else {
        tiles_->run(worker.passes, team_, static_cast<int>(count));
    }
}

}  // namespace

std::unique_ptr<Executor> make_thread_executor(const StepProblem& problem,
                                               std::vector<Field> species, int most_threads,
                                               bool keeps) {
    return std::make_unique<ThreadExecutor>(problem, std::move(species), most_threads, keeps,
                                            nullptr);
}

std::unique_ptr<Executor> make_part_executor(const StepProblem& problem, std::vector<Field> species,
                                             int most_threads, bool keeps, Exchange& others) {
    return std::make_unique<ThreadExecutor>(problem, std::move(species), most_threads, keeps,
                                            &others);
}

}  // namespace cascade
