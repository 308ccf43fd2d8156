// A team of threads that runs the passes of steps, several of them together if tiles save memory
// traffic.
#pragma once

#include "core/parallel.h"
#include "solvers/pass_runner.h"
#include "solvers/stage_clock.h"
#include "solvers/step_planes.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"
#include "solvers/tile_runner.h"
#include "solvers/tiling.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// A pass of a step, and the roles of the copies when the step begins.
struct StepPass {
    std::size_t pass = 0;
    std::int64_t complete = 0;  ///< Complete steps before it.
    CopyRoles roles;
};

class PassTeam {
public:
    /// The work of a thread on its share of the cells.
    using OwnCells = std::function<void(int thread, const Patch& cells)>;

    /// At first all threads are in use, but no more than the grid is worth. `problem` must outlive
    /// its use.
    PassTeam(const StepProblem& problem, std::size_t species, int most_threads);

    const StepProblem& problem() const { return *problem_; }
    /// From now on runs the passes of another problem over the same grid.
    void use(const StepProblem& problem);

    int most_threads() const { return team_.size(); }
    /// Sets the number of threads that share the work; no result depends on it.
    void use_threads(int threads);

    /// The tiling that fits the machine's caches.
    const Tiling& fitting_tiling() const { return fitting_tiling_; }
    /// That tiling, and others that may be faster.
    std::vector<Tiling> tilings_to_try() const {
        return cascade::tilings_to_try(*problem_, reach_, CacheSizes::here(), most_threads());
    }
    /// From now on uses this tiling, even if the problem changes; no result depends on it. Layers
    /// are made at least as large as the reach of links.
    void use_tiling(const Tiling& tiling);
    /// The number of passes of steps for each pass through memory, as far as the passes allow.
    int levels() const { return tiles_->levels(); }
    /// How steps go through memory.
    Stepping stepping() const {
        return stepping_with(*problem_, tiling_, tiles_->levels(), tiles_->phases());
    }

    /// Runs `count` passes from `first` on. Then every thread calls `after` with its own cells,
    /// which are complete; `after` may be null.
    /// If `cancel`, which may be null, becomes true, run() and run_step() abandon their work; what
    /// passes write is then unknown.
    void run(StepPlanes& planes, const StageClock& clock, StepPass first, std::size_t count,
             const OwnCells& after, const std::atomic<bool>* cancel);
    /// Runs the passes of one step from `first` on, and calls `written` for all rows of the last.
    void run_step(StepPlanes& planes, const StageClock& clock, StepPass first,
                  const RowsWritten& written, const std::atomic<bool>* cancel);
    /// Every thread calls `work` with its own cells.
    void run(const OwnCells& work);

private:
    struct Worker {
        PassRunner::Worker passes;
        std::vector<std::span<Field>> registers;
    };
    /// The arguments of all threads.
    struct Given {
        StepPlanes& planes;
        const StageClock& clock;
        const std::atomic<bool>* cancel = nullptr;
        const RowsWritten* written_by_last =
            nullptr;  ///< For the last pass of a step; may be null.
    };

    void set_tiling(const Tiling& tiling);
    void run(const Given& given, const StepPass& first, std::size_t count, const OwnCells& after);
    void run_passes(Worker& worker, const Given& given, StepPass next, std::size_t left,
                    bool meets);
    std::size_t passes_together(const StepPass& next, std::size_t left) const;
    void run_together(Worker& worker, const Given& given, StepPass& next, std::size_t count);

    const StepProblem* problem_;
    PlaneLayout layout_;
    Team team_;
    std::optional<PassRunner> runner_;
    std::int64_t reach_ = 1;  ///< The number of rows that links reach.
    Tiling fitting_tiling_, tiling_;
    bool is_tiling_given_ = false;
    std::optional<TileRunner> tiles_;
    std::vector<Worker> workers_;  ///< One for each thread in use.
};

}  // namespace cascade
