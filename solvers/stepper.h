// Takes steps: a team of threads runs the passes over planes that are swapped. Used by the time
// loop, which decides the number of steps and when to check values.
#pragma once

#include "core/plane.h"
#include "solvers/pass_team.h"
#include "solvers/stage_clock.h"
#include "solvers/step_planes.h"
#include "solvers/step_problem.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

class Stepper {
public:
    /// Takes `species` as current, and as kept unless `keeps` is false; fills their halo. At first
    /// all threads are in use; `most_threads` is lowered to what the grid is worth.
    Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
            bool keeps = true);

    StepPlanes& planes() { return planes_; }
    PassTeam& team() { return team_; }
    const PassTeam& team() const { return team_; }

    /// The passes in use.
    const StepProblem& problem() const { return team_.problem(); }
    /// Uses the passes of another problem from now on. It must outlive its use.
    void use(const StepProblem& problem);
    /// Sets time and length of the steps from now on.
    void set_clock(const StageClock& clock) { clock_ = clock; }
    /// From now on, when `cancel` becomes true, a step that is taken by itself is left undone:
    /// advance() and attempt() abandon their work, and the current values are as before. Several
    /// steps taken at once, which are short, are completed.
    void leave_on(const std::atomic<bool>& cancel) { cancel_ = &cancel; }

    /// Takes `count` steps, at least one, after `complete` earlier ones. With `look`, returns
    /// whether the new values are all finite; without it, true.
    bool advance(std::int64_t complete, std::int64_t count, bool look);
    /// Are all current values finite?
    bool is_finite();
    /// Goes back to the kept copy.
    void back() {
        planes_.back();
        knows_first_rates_ = false;
    }

    /// Tries one step of a problem with an error register and returns its error in units of the
    /// tolerance: for each species the root mean square of the error, divided by that of its new
    /// values and by `tolerance`; the largest of them; NaN if an error or a new value is not
    /// finite. Then call accept(), or undo the step by giving the planes their former roles.
    double attempt(std::int64_t complete, double tolerance);
    /// Accepts the step just tried: its last rates become the first rates of the next step.
    void accept();
    /// Must be called when current values have been changed from outside.
    void forget_rates() { knows_first_rates_ = false; }
    /// The planes of the error estimate, one for each species.
    const std::vector<Field>& error_planes() const {
        return planes_.scratch(*problem().error_register);
    }

private:
    /// Sums of squares by row.
    struct Squares {
        std::vector<double> of_errors, of_values;
    };

    PassTeam::OwnCells look_at(int copy);
    bool all_finite() const;
    void add_squares(RowRange rows);

    StepPlanes planes_;
    PassTeam team_;
    StageClock clock_;
    const std::atomic<bool>* cancel_ = nullptr;
    /// The register of first rates holds the rates of the current copy.
    bool knows_first_rates_ = false;
    std::vector<Squares> squares_;      ///< By species.
    std::vector<std::uint8_t> finite_;  ///< By thread: are its cells finite?
};

}  // namespace cascade
