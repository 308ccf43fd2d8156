// The time loop of a tissue: steps with a small error, divisions and deaths at their moments, and
// lists of neighbours that are never outdated.
//
// Results are the same bit for bit with any number of threads and any order of cells in memory.
// They depend neither on when lists are built nor on where a run is stopped and resumed.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "ir/solver.h"
#include "tissue/neighbours.h"
#include "tissue/sense_kernel.h"
#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace cascade {

/// The progress of a tissue: the largest of speed · τ / size over the species, where τ is the time
/// since the last division or death. A species' speed is the root mean square, over the cells, of
/// its rate of change. So progress is the relative change of values that their present speeds would
/// cause in another time τ. It rises while cells move, and falls when cells come to rest.
double progress_of(std::span<const double> changes, double step, std::span<const double> sizes,
                   std::span<const std::size_t> restless, double since_event);

/// Whether the tissue is at rest. Its progress must be at most `tolerance`. In addition, progress
/// must have been at least 3 · `tolerance` at some time since the last division or death, or the
/// time since then must be at least a hundred times the time scale of the fastest rate. Without
/// this second condition the first steps after a division would count as rest.
bool is_at_rest(const TissueTime& time, double progress, double tolerance);

/// Counts of births and deaths in a time in which the number of cells hardly changed.
struct Turnover {
    std::int64_t births = 0, deaths = 0, cells = 0;
    double from = 0, to = 0;
};
/// Finds out whether cells only replace each other. For this, since the last comparison, at least
/// four times as many cells as exist must have been born, at least as many must have died, and the
/// number of cells must have changed by at most a tenth. Such a tissue may go on for ever. Must be
/// called after events. A new comparison begins whenever four times as many cells as exist have
/// been born.
bool compare_turnover(Tissue& tissue, Turnover& turnover);

/// Called at a complete step, whose values are in tissue.species. Returns false to end the stage.
using TissueObserver = std::function<bool(const Tissue& tissue)>;

/// The steps that a tissue's time loop takes.
struct TissueSchedule {
    Solver solver = Solver::rkl2;
    /// The largest error of a step, relative to sizes_of(). If it is 0, all steps have the length
    /// `step`.
    double tolerance = 1e-3;
    double step = 0;  ///< The length of fixed steps.
    double largest_step = std::numeric_limits<double>::infinity();
    /// The time at which the stage ends. The last step is shortened to end there.
    double end_time = std::numeric_limits<double>::infinity();
    double every = 0;                   ///< If above 0, a step ends at each multiple of this time.
    double steady = 0;                  ///< If above 0, the stage ends at rest; see is_at_rest().
    bool has_exact_events = false;      ///< Whether a step ends at each event.
    std::uint32_t seed = 0, stage = 0;  ///< Used for random directions of division.
    NeighbourRule neighbours;           ///< Its `period` is the period of the surroundings.
    double skin = 0.3;  ///< The skin of lists of neighbours. No result depends on it.
    double most_list_bytes = 4e9;
    std::size_t most_cells = 10'000'000;
    int threads = 1;
    std::int64_t check = 0;    ///< `ends` is called every `check` steps; never if this is 0.
    TissueObserver ends = {};  ///< Returns true to end the stage.
    /// `keep_is_due` is called after each step. If it returns true, the state must be saved, and
    /// `keep` is called. The answer does not influence the run's results.
    std::function<bool()> keep_is_due = {};
    std::function<void(const Tissue& tissue)> keep = {};
    /// Returns the first moment to observe after t, or infinity. `at_moment` is called at each of
    /// these moments, with values interpolated between the ends of the step that contains the
    /// moment. The steps stay the same.
    std::function<double(double t)> next_moment = {};
    std::function<void(const Tissue& tissue)> at_moment = {};
    /// Called once, when compare_turnover() first finds that cells only replace each other.
    std::function<void(const Turnover& turnover)> turns_over = {};
};

/// The reason why a tissue cannot continue. The tissue contains the state after the last complete
/// step.
struct TissueFailure {
    enum class Kind : std::uint8_t {
        not_finite,       ///< A value of cell `number` is not finite after a step from `t`.
        rate_not_finite,  ///< A rate of cell `number` is not finite.
        too_short,        ///< Steps have become too short. The error is largest in cell `number`.
        too_far,          ///< A fixed step would move a cell too far, or is not stable.
        /// The condition of division still holds for the cell after ten divisions in a row.
        divides_for_ever,
        too_many_cells,      ///< There would be `cells` cells, which are too many.
        too_many_neighbours  ///< `refusal` is the message.
    };
    Kind kind = Kind::not_finite;
    std::uint32_t number = 0;
    std::size_t species = 0;
    double t = 0, step = 0;
    std::size_t cells = 0;
    Failure refusal = {};
};

struct TissueOutcome {
    std::int64_t steps = 0;  ///< Number of complete steps of the stage.
    double t = 0;
    bool cancelled = false;
    /// Whether the stage ended: by its end time, by `ends`, at rest, or because no cell is left.
    bool ended = false;
    bool is_steady = false;  ///< Whether the tissue is at rest.
    std::optional<TissueFailure> failure;
    std::optional<Turnover> turnover;  ///< The first turnover that was found.
    std::int64_t list_builds = 0;
};

class TissueLoop {
public:
    /// All arguments must outlive the loop. Only the loop may change the tissue meanwhile.
    /// `triangles` is the object that was given to the kernels of senses. Throws std::bad_alloc.
    TissueLoop(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
               std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
               TissueSchedule schedule, Progress progress);
    ~TissueLoop();
    TissueLoop(const TissueLoop&) = delete;
    TissueLoop& operator=(const TissueLoop&) = delete;

    /// Continues until tissue.time.steps is `last_step`. Observes at multiples of `interval`, or
    /// never if this is 0. Uses `control` as TimeLoop::advance() does. May be called again unless
    /// an earlier call failed. Throws std::bad_alloc.
    TissueOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                          const TissueObserver& observe);

private:
    class Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
