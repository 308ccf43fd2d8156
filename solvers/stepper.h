// Stepping: two or three copies of every species, a team of threads, and who writes where. Used by
// advance(), which decides how many steps to take and when to look.
//
// Two copies change places from step to step. The third, where there is memory for it, is the kept
// one: keep() declares the current copy the kept one without moving a byte, and steps go on between
// the other two, so that back() can return there. Keeping is therefore free.
#pragma once

#include "core/check.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "solvers/pass_runner.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"
#include "solvers/tile_runner.h"
#include "solvers/tiling.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Which of the copies is what.
struct CopyRoles {
    static constexpr int none = -1;
    int kept = 0;  ///< `none` of two copies.
    int current = 0;

    /// The copy that the next step writes: neither kept nor current.
    int target() const {
        if (kept == none) return 1 - current;
        return current == kept ? (current + 1) % 3 : 3 - kept - current;
    }
};

class Stepper {
public:
    /// Takes `species` as current, and as kept unless it `keeps` nothing; their halo is filled
    /// here. All threads are in use at first; `most_threads` is lowered to what the grid is worth.
    Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
            bool keeps = true);

    /// Takes `count` steps, at least one; `complete` were complete before. With `look`, returns
    /// whether the new values are all finite; without, true.
    bool advance(std::int64_t complete, std::int64_t count, bool look);

    /// Time and length of the steps from now on.
    void set_clock(const StageClock& clock) { clock_ = clock; }
    /// The passes in use.
    const StepProblem& problem() const { return *problem_; }
    /// Takes steps by other passes from now on. The problem must live as long as it is in use.
    void use(const StepProblem& problem);

    /// Tries one step of a problem with an error register and returns its error in units of the
    /// tolerance: of each species the root mean square over that of its new values, times
    /// `tolerance`; the largest of all; NaN where the error or a new value is not finite. Then
    /// undo() or accept().
    double attempt(std::int64_t complete, double tolerance);
    /// The step just tried is taken: its last rates are the first ones of the next step.
    void accept();
    /// The planes of that estimate, one for each species.
    const std::vector<Field>& error_planes() const {
        return scratch_[place_of(problem_->error_register)];
    }

    /// Are all current values finite?
    bool is_finite();

    /// Is there a kept copy? Without one nothing becomes of keep(), and nobody may go back().
    bool keeps() const { return roles_.kept != CopyRoles::none; }
    void keep() {
        if (keeps()) roles_.kept = roles_.current;
    }
    void back() {
        CHECK(keeps(), "there is a copy to go back to");
        roles_.current = roles_.kept;
        knows_first_rates_ = false;
    }
    /// Undoes the last step: `before` are the roles as they were before it.
    void undo(CopyRoles before) { roles_ = before; }
    CopyRoles roles() const { return roles_; }

    /// The current copy, to be exchanged with the caller's vector and back again.
    std::vector<Field>& current() { return copies_[roles_.current]; }
    std::vector<Field>& kept() { return copies_[roles_.kept]; }

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
    /// Steps that one pass through memory takes, at least 1.
    std::int64_t steps_at_once() const {
        const auto passes = static_cast<std::int64_t>(problem_->passes.size());
        return (tiles_->levels() + passes - 1) / passes;
    }
    /// How steps go through memory.
    Stepping stepping() const {
        return stepping_with(*problem_, tiling_, tiles_->levels(), tiles_->phases());
    }

private:
    struct Worker {
        PassRunner::Worker passes;
        std::vector<std::span<void* const>> registers;
        bool finite = true;
    };
    /// Sums of squares by row.
    struct Squares {
        std::vector<double> of_errors, of_values;
    };

    void set_tiling(const Tiling& tiling);
    /// A pass of a step that begins with certain roles.
    struct Level {
        std::size_t pass = 0;
        std::int64_t complete = 0;
        CopyRoles roles;
        void go_on(std::size_t passes);
    };
    void work(Worker& worker, Level level, std::size_t levels, bool meets);
    std::size_t levels_from(const Level& level, std::size_t left) const;
    void run_levels(Worker& worker, Level& level, std::size_t count);
    void set_registers(Worker& worker, CopyRoles roles) const;
    StepMoment moment_of(std::int64_t complete) const;
    bool rows_finite(const Worker& worker, int copy) const;
    bool all_finite() const;
    void add_scratch();
    void add_squares(const Worker& worker);
    std::size_t place_of(std::uint32_t scratch_register) const {
        return scratch_register - first_scratch;
    }

    static constexpr std::uint32_t first_scratch = 2;

    const StepProblem* problem_;
    PlaneLayout layout_;
    StageClock clock_;
    std::array<std::vector<Field>, 3> copies_;  ///< The last is empty where nothing is kept.
    std::array<std::vector<void*>, 3> cells_;   ///< Species of a copy.
    std::vector<std::vector<Field>> scratch_;   ///< Registers from 2 on.
    std::vector<std::vector<void*>> scratch_cells_;
    CopyRoles roles_;
    bool knows_first_rates_ =
        false;  ///< The register of first rates holds those of the current copy.
    std::vector<Squares> squares_;  ///< By species.
    Team team_;
    std::optional<PassRunner> runner_;
    std::int64_t reach_ = 1;  ///< Rows that links reach.
    Tiling fitting_tiling_, tiling_;
    bool is_tiling_given_ = false;
    std::optional<TileRunner> tiles_;
    std::vector<Worker> workers_;  ///< One for each thread in use.
};

}  // namespace cascade
