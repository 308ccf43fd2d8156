// Every thread runs all passes on its rows and waits for the others where a pass reads their rows.
#include "solvers/pass_team.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {
namespace {

/// With fewer values than this per thread and step, a barrier costs more than a thread saves:
/// computing them takes about 10 µs, a barrier about 1. Cells with links take longer.
constexpr std::int64_t least_values_per_thread = 16384;
constexpr std::int64_t least_linked_values_per_thread = 8192;

int worthwhile_threads(const Grid& grid, std::size_t species, int most) {
    const std::int64_t values = grid.cell_count() * static_cast<std::int64_t>(species);
    const std::int64_t least =
        grid.linked ? least_linked_values_per_thread : least_values_per_thread;
    const std::int64_t parts =
        has_few_rows(grid) ? grid.width / PlaneLayout::row_pad : grid.height * grid.depth;
    const std::int64_t worth = std::min(values / least, parts);
    return static_cast<int>(std::clamp<std::int64_t>(worth, 1, std::max(most, 1)));
}

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

}  // namespace

PassTeam::PassTeam(const StepProblem& problem, std::size_t species, int most_threads)
    : problem_(&problem),
      layout_(problem.grid),
      team_(worthwhile_threads(problem.grid, species, most_threads)),
      runner_(std::in_place, problem) {
    if (problem.grid.linked) reach_ = rows_reached(problem);
    fitting_tiling_ = tiling_ = choose_tiling(problem, reach_, CacheSizes::here());
    use_threads(team_.size());
}

void PassTeam::use(const StepProblem& problem) {
    if (&problem == problem_) return;
    CHECK(problem.grid == problem_->grid, "passes of one grid");
    problem_ = &problem;
    runner_.emplace(problem);
    for (Worker& worker : workers_) {
        runner_->prepare(worker.passes, worker.passes.number, worker.passes.count);
    }
    fitting_tiling_ = choose_tiling(problem, reach_, CacheSizes::here());
    set_tiling(is_tiling_given_ ? tiling_ : fitting_tiling_);
}

void PassTeam::use_threads(int threads) {
    if (static_cast<std::size_t>(threads) == workers_.size()) return;
    workers_.resize(static_cast<std::size_t>(threads));
    for (int index = 0; index < threads; ++index) {
        runner_->prepare(workers_[static_cast<std::size_t>(index)].passes, index, threads);
    }
    set_tiling(tiling_);
}

void PassTeam::use_tiling(const Tiling& tiling) {
    if (is_tiling_given_ && tiling == tiling_) return;
    is_tiling_given_ = true;
    set_tiling(tiling);
}

void PassTeam::set_tiling(const Tiling& tiling) {
    tiling_ = tiling;
    Tiling reaching = tiling;
    if (problem_->grid.linked) reaching.outer_layer = std::max(reaching.outer_layer, reach_);
    tiles_.emplace(*runner_, reaching, static_cast<int>(workers_.size()));
}

void PassTeam::run(StepPlanes& planes, const StageClock& clock, StepPass first, std::size_t count,
                   const OwnCells& after, const std::atomic<bool>* cancel) {
    run({planes, clock, cancel}, first, count, after);
}

void PassTeam::run_step(StepPlanes& planes, const StageClock& clock, StepPass first,
                        const RowsWritten& written, const std::atomic<bool>* cancel) {
    run({planes, clock, cancel, &written}, first, problem_->passes.size() - first.pass, nullptr);
}

void PassTeam::run(const Given& given, const StepPass& first, std::size_t count,
                   const OwnCells& after) {
    team_.run(
        [&](int thread) {
            Worker& worker = workers_[static_cast<std::size_t>(thread)];
            run_passes(worker, given, first, count, after != nullptr);
            if (after) after(thread, worker.passes.cells);
        },
        static_cast<int>(workers_.size()));
}

void PassTeam::run(const OwnCells& work) {
    team_.run(
        [&](int thread) { work(thread, workers_[static_cast<std::size_t>(thread)].passes.cells); },
        static_cast<int>(workers_.size()));
}

/// Runs `left` passes from `next` on. `meets`: each thread's own cells must be complete at the end.
void PassTeam::run_passes(Worker& worker, const Given& given, StepPass next, std::size_t left,
                          bool meets) {
    while (left > 0) {
        const std::size_t together = passes_together(next, left);
        run_together(worker, given, next, together);
        left -= together;
        // One barrier is enough: after it no thread reads the copy that the next pass overwrites,
        // and every thread has filled the halo that copies its own rows. Tiles and columns may end
        // in any thread's cells.
        const bool is_elsewhere = tiles_->levels() > 1 || has_few_rows(problem_->grid);
        if (left > 0 || (meets && is_elsewhere)) team_.barrier();
    }
    if (given.written_by_last == nullptr || !tiles_->is_along_columns()) return;
    team_.barrier();
    (*given.written_by_last)(worker.passes.rows);
}

/// The number of passes to run together if `left` remain: tiles of nearly equal heights, up to a
/// pass that needs all rows.
std::size_t PassTeam::passes_together(const StepPass& next, std::size_t left) const {
    const auto most = static_cast<std::size_t>(tiles_->levels());
    const std::size_t passes = problem_->passes.size();
    std::size_t free = 1;
    while (free < left && !needs_all_rows(problem_->passes[(next.pass + free) % passes])) {
        if (++free > 2 * most) return most;
    }
    const std::size_t tiles = (free + most - 1) / most;
    return (free + tiles - 1) / tiles;
}

void PassTeam::run_together(Worker& worker, const Given& given, StepPass& next, std::size_t count) {
    const std::size_t passes = problem_->passes.size();
    for (std::size_t number = 0; number < count; ++number) {
        if (number == 0 || next.pass == 0) given.planes.list(next.roles, worker.registers);
        const StepMoment moment = moment_of(next.complete, given.clock, given.cancel);
        if (number == 0) {
            runner_->prepare_pass(worker.passes, team_, next.pass, worker.registers, moment);
        }
        // The first pass of a tile brings the data of the others into the cache.
        runner_->bind(worker.passes, number, next.pass, worker.registers, moment,
                      tiling_.is_near && number > 0,
                      next.pass + 1 == passes && !tiles_->is_along_columns() ? given.written_by_last
                                                                             : nullptr);
        go_on(next, passes);
    }
    if (count == 1 && !tiles_->is_along_columns()) {
        runner_->run_cells(worker.passes, 0, {worker.passes.rows});
    } else {
        tiles_->run(worker.passes, team_, static_cast<int>(count));
    }
}

}  // namespace cascade
