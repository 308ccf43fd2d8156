// The time loop of a tissue: steps with a small error, divisions and deaths at their moments, and
// lists of neighbours that are never outdated.
//
// Results depend neither on threads, nor on the order of cells in memory, nor on when lists are
// built, nor on where a run was stopped and resumed.
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

/// The progress of a tissue says how far its values would change at their present speeds in a time
/// τ, the time since the last division or death: the largest of speed · τ / size over the species,
/// where speed is the root mean square over the cells of change by time. It rises while cells move,
/// and falls when they come to rest.
double progress_of(std::span<const double> changes, double step, std::span<const double> sizes,
                   std::span<const std::size_t> restless, double since_event);

/// Whether the tissue is at rest: its progress is at most `tolerance`, and either it was three
/// times as large since the last event, or τ is a hundred times the time scale of the fastest rate.
/// Without the second condition the first steps after an event would count as rest.
bool is_at_rest(const TissueTime& time, double progress, double tolerance);

/// Births and deaths while the number of cells hardly changed.
struct Turnover {
    std::int64_t births = 0, deaths = 0, cells = 0;
    double from = 0, to = 0;
};
/// Called after events. Finds a turnover if, since the last comparison, at least four times as many
/// cells as exist were born and as many died, while their number changed by a tenth at most. Such a
/// tissue may go on for ever. Begins a new comparison whenever that number of cells was born.
bool compare_turnover(Tissue& tissue, Turnover& turnover);

/// Called at a complete step, with its values in tissue.species. Returns false to end the stage.
using TissueObserver = std::function<bool(const Tissue& tissue)>;

/// The choice of steps.
struct TissueSchedule {
    Solver solver = Solver::rkl2;
    double tolerance = 1e-3;  ///< For the error of a step, relative to sizes_of(). 0: fixed steps.
    double step = 0;          ///< The length of fixed steps.
    double largest_step = std::numeric_limits<double>::infinity();
    double end_time = std::numeric_limits<double>::infinity();  ///< A step ends there.
    double steady = 0;                  ///< Above 0: ends at rest, see is_at_rest().
    bool has_exact_events = false;      ///< A step ends at each event.
    std::uint32_t seed = 0, stage = 0;  ///< For random directions of division.
    NeighbourRule neighbours;           ///< Its period is that of the surroundings.
    double skin = 0.3;                  ///< No result depends on it.
    double most_list_bytes = 4e9;
    std::size_t most_cells = 10'000'000;
    int threads = 1;
    std::int64_t check = 0;    ///< `ends` is called at multiples of this. 0: never.
    TissueObserver ends = {};  ///< Returns true to end the stage.
    /// Called after each step: whether the state must be kept. Then `keep` is called. No result
    /// depends on them.
    std::function<bool()> keep_is_due = {};
    std::function<void(const Tissue& tissue)> keep = {};
    /// Called once, when cells are first seen to only replace each other.
    std::function<void(const Turnover& turnover)> turns_over = {};
};

/// Why a tissue cannot go on. It remains as after the last complete step.
struct TissueFailure {
    enum class Kind : std::uint8_t {
        not_finite,          ///< A value of cell `number` is not finite after a step from `t`.
        rate_not_finite,     ///< A rate of cell `number` is not finite.
        too_short,           ///< Steps have become too short. The error is largest in that cell.
        too_far,             ///< A fixed step would move a cell too far, or is not stable.
        divides_for_ever,    ///< The cell still wants to divide after ten divisions in a row.
        too_many_cells,      ///< The number would be `cells`.
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
    std::int64_t steps = 0;  ///< Complete steps of the stage.
    double t = 0;
    bool cancelled = false;
    bool ended = false;      ///< By its end time, by `ends`, at rest, or because no cell is left.
    bool is_steady = false;  ///< At rest.
    std::optional<TissueFailure> failure;
    std::optional<Turnover> turnover;  ///< The first one seen.
    std::int64_t list_builds = 0;
};

class TissueLoop {
public:
    /// All arguments must outlive the loop. Nothing else may change the tissue meanwhile.
    /// `triangles` belong to the sensing kernels. Throws std::bad_alloc.
    TissueLoop(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
               std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
               TissueSchedule schedule, Progress progress);
    ~TissueLoop();
    TissueLoop(const TissueLoop&) = delete;
    TissueLoop& operator=(const TissueLoop&) = delete;

    /// Continues until tissue.time.steps is `last_step`, observing at multiples of `interval` (0:
    /// never). Reports and is cancelled like TimeLoop::advance(). May be called again unless it
    /// failed. Throws std::bad_alloc.
    TissueOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                          const TissueObserver& observe);

private:
    class Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
