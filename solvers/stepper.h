// Takes steps: a team of threads runs their passes over planes that change places. Used by the time
// loop, which decides how many steps to take and when to look.
#pragma once

#include "core/plane.h"
#include "solvers/pass_team.h"
#include "solvers/stage_clock.h"
#include "solvers/step_planes.h"
#include "solvers/step_problem.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

class Stepper {
public:
    /// Takes `species` as current, and as kept unless it `keeps` nothing; their halo is filled
    /// here. All threads are in use at first; `most_threads` is lowered to what the grid is worth.
    Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
            bool keeps = true);

    StepPlanes& planes() { return planes_; }
    PassTeam& team() { return team_; }
    const PassTeam& team() const { return team_; }

    /// The passes in use.
    const StepProblem& problem() const { return team_.problem(); }
    /// Takes steps by other passes from now on. The problem must live as long as it is in use.
    void use(const StepProblem& problem);
    /// Time and length of the steps from now on.
    void set_clock(const StageClock& clock) { clock_ = clock; }

    /// Takes `count` steps, at least one; `complete` were complete before. With `look`, returns
    /// whether the new values are all finite; without, true.
    bool advance(std::int64_t complete, std::int64_t count, bool look);
    /// Are all current values finite?
    bool is_finite();
    /// Goes back to the kept copy.
    void back() {
        planes_.back();
        knows_first_rates_ = false;
    }

    /// Tries one step of a problem with an error register and returns its error in units of the
    /// tolerance: of each species the root mean square over that of its new values, times
    /// `tolerance`; the largest of all; NaN where the error or a new value is not finite. Then
    /// accept() it, or undo it by giving the planes the roles they had before.
    double attempt(std::int64_t complete, double tolerance);
    /// The step just tried is taken: its last rates are the first ones of the next step.
    void accept();
    /// The planes of that estimate, one for each species.
    const std::vector<Field>& error_planes() const {
        return planes_.scratch(problem().error_register);
    }

private:
    /// Sums of squares by row.
    struct Squares {
        std::vector<double> of_errors, of_values;
    };

    PassTeam::OwnRows look_at(int copy);
    bool all_finite() const;
    void add_squares(RowRange rows);

    StepPlanes planes_;
    PassTeam team_;
    StageClock clock_;
    /// The register of first rates holds those of the current copy.
    bool knows_first_rates_ = false;
    std::vector<Squares> squares_;      ///< By species.
    std::vector<std::uint8_t> finite_;  ///< By thread: are its rows?
};

}  // namespace cascade
