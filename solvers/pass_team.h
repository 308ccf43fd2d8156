// A team of threads that runs the passes of steps, several of them together where tiles save ways
// through memory.
#pragma once

#include "core/parallel.h"
#include "solvers/pass_runner.h"
#include "solvers/stage_clock.h"
#include "solvers/step_planes.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"
#include "solvers/tile_runner.h"
#include "solvers/tiling.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// A pass of a step that begins with certain roles.
struct StepPass {
    std::size_t pass = 0;
    std::int64_t complete = 0;  ///< Steps before it.
    CopyRoles roles;
};

class PassTeam {
public:
    /// What a thread does with its rows.
    using OwnRows = std::function<void(int thread, RowRange rows)>;

    /// All threads are in use at first, but no more than the grid is worth. `problem` must live as
    /// long as it is in use.
    PassTeam(const StepProblem& problem, std::size_t species, int most_threads);

    const StepProblem& problem() const { return *problem_; }
    /// Runs other passes over the same grid from now on.
    void use(const StepProblem& problem);

    int most_threads() const { return team_.size(); }
    /// So many threads share the work from now on; no result depends on it.
    void use_threads(int threads);

    /// The tiling that fits the machine's caches.
    const Tiling& fitting_tiling() const { return fitting_tiling_; }
    /// That one, and others that may be faster.
    std::vector<Tiling> tilings_to_try() const {
        return cascade::tilings_to_try(*problem_, reach_, CacheSizes::here(), most_threads());
    }
    /// Goes through memory like that from now on, also where the problem changes; no result depends
    /// on it. Layers are made as large as links reach.
    void use_tiling(const Tiling& tiling);
    /// So many passes of steps are done for each pass through memory, where they allow it.
    int levels() const { return tiles_->levels(); }
    /// How steps go through memory.
    Stepping stepping() const {
        return stepping_with(*problem_, tiling_, tiles_->levels(), tiles_->phases());
    }

    /// Runs `count` passes from `first` on; then every thread calls `after` with the rows that are
    /// its own, which are complete.
    void run(StepPlanes& planes, const StageClock& clock, StepPass first, std::size_t count,
             const OwnRows& after);
    /// Every thread calls `work` with its own rows.
    void run(const OwnRows& work);

private:
    struct Worker {
        PassRunner::Worker passes;
        std::vector<std::span<Field>> registers;
    };
    /// What all threads are given.
    struct Given {
        StepPlanes& planes;
        const StageClock& clock;
    };

    void set_tiling(const Tiling& tiling);
    void run_passes(Worker& worker, const Given& given, StepPass next, std::size_t left,
                    bool meets);
    std::size_t passes_together(const StepPass& next, std::size_t left) const;
    void run_together(Worker& worker, const Given& given, StepPass& next, std::size_t count);

    const StepProblem* problem_;
    PlaneLayout layout_;
    Team team_;
    std::optional<PassRunner> runner_;
    std::int64_t reach_ = 1;  ///< Rows that links reach.
    Tiling fitting_tiling_, tiling_;
    bool is_tiling_given_ = false;
    std::optional<TileRunner> tiles_;
    std::vector<Worker> workers_;  ///< One for each thread in use.
};

}  // namespace cascade
