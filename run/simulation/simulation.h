// The state of a run: the values of every stage's items, and their computation.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "ir/tiered_backend.h"
#include "lang/lower/lower.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"
#include "run/simulation/backends.h"
#include "run/simulation/simulation_domain.h"
#include "run/stage/stage_state.h"
#include "run/stage/time_account.h"
#include "solvers/advance.h"
#include "solvers/executor.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct SimulationOptions {
    std::string_view backend = fastest_backend().name;  ///< A name of the table of backends.
    int lanes = 0;                                      ///< As in BackendOptions.
    int threads = 0;                                    ///< 0: all threads of the machine.
    /// What takes the steps of stages of fields. No result depends on it.
    MakeExecutor executor = make_thread_executor;
    /// Compiles the steps of several simulations, so that equal kernels are compiled once; null:
    /// each simulation has its own.
    std::shared_ptr<TieredBackend> stepper = nullptr;
    /// Receives progress while the cells of a model are made, and may cancel it; may be null.
    RunControl* control = nullptr;
    /// Refuses a model before its cells are made; may be empty.
    std::function<Result<void>(const SurfaceMesh&)> check_model = {};
    TimeAccount* account = nullptr;  ///< Receives the times spent; may be null.
    std::filesystem::path cell_cache =
        {};  ///< The folder in which cells of models are kept; empty: none.
    /// The folder in which compiled kernels and the fastest tilings are kept for later processes;
    /// empty: none.
    std::filesystem::path kernel_cache = {};
    /// Interpret the first steps while their code is compiled, unless the grid is so large that
    /// waiting is faster. Affects the time of a step, but no result.
    bool starts_interpreted = false;
    std::uint64_t memory_limit = 0;  ///< The most bytes for all fields; 0: the free memory.
    /// The cells of the script's model, where another simulation has made them; else null.
    std::shared_ptr<const ModelCells> known_model = nullptr;
    /// Of an earlier simulation (SimulationDomain::known_sizes); no result depends on them.
    std::map<std::string, double> known_sizes = {};
    /// The choice of operands that are written to planes. No result depends on it.
    PlanOptions planning = {Materialise::when_cheaper, false, true};
    /// The tiling; none: chosen by size and by time. No result depends on it.
    std::optional<Tiling> tiling = {};
};

/// The stepper of `options`, which simulations may share. Fails if its backend is not available.
Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options);

/// The first moment after t at which a stage is to be observed, in its own time; infinity if there
/// is none.
using NextMoment = std::function<double(double t)>;

/// Why a stage ended.
enum class StageEnd { finished, stopped, cancelled };

class StageView;

/// Runs the stages of a checked program, one after the other. Owns all fields.
class Simulation {
public:
    /// Checks memory and reads the files that the script names. Faults of such files are added to
    /// `script.diagnostics`, and the result fails. `script` must outlive the simulation.
    static Result<std::unique_ptr<Simulation>> create(Script& script,
                                                      const SimulationOptions& options);
    ~Simulation();

    /// Computes the starting values of a stage from earlier stages. Fails if `speed` is not above 0
    /// or a starting value is not finite. Making a grown body takes long: if `cancel` becomes true,
    /// it fails, and the stage has not started.
    Result<void> start_stage(std::uint32_t stage,
                             const std::atomic<bool>& cancel = never_cancelled);

    /// Takes steps until `last_step` are complete. The first call allocates what steps need and
    /// keeps it for further calls, until the stage ends or states are changed. A stage with a
    /// coarse start first runs on coarser grids, without observation. `observe` is called at
    /// multiples of `every`, or of the stage's interval if `every` is 0; for a stage without an
    /// interval, at tenths of its duration. With `next_moment`, for a stage of fields whose speed
    /// is the same in all cells, `observe` is called at its moments instead, which are read between
    /// steps (run/simulation/between_steps.h). If values are not finite, it fails with stage,
    /// species, cell, step and the largest stable speed.
    Result<StageEnd> advance_stage(std::uint32_t stage, std::int64_t last_step, RunControl& control,
                                   const std::function<void()>& observe, std::int64_t every = 0,
                                   const NextMoment& next_moment = {});

    /// From now on, `is_due` is called some fifty times a second while steps are taken. If it
    /// returns true, `keep` is called at a complete step; a run can go on from the simulation's
    /// states then with the same bits. Steps on coarser grids before a stage's first step are not
    /// kept.
    void keep_with(std::function<bool()> is_due, std::function<void()> keep);

    /// Waits for code of stages that ended before it was ready, and warns of kernels that could not
    /// be compiled and were interpreted.
    void settle(RunControl& control);

    /// Changes a started stage between two steps, in its own cells. What was computed from old
    /// values when the stage started is kept: other parameters, and values of sides.
    void change_stage(std::uint32_t stage, const std::function<void(StageState&)>& change);

    /// Carries a run of the same script to the cells of this one, which are divided
    /// (DomainSettings::detail), and makes `stage` go on here until its pattern has settled (see
    /// run/simulation/finer_run.h). No stage of this simulation has started.
    Result<void> go_on_from(const Simulation& coarse, std::uint32_t stage);

    /// Evaluates a formula for pictures over the present state: one field, or three for a colour.
    /// Outside of the mask it is NaN, unless it is the same in all cells.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;
    /// Several formulas at once; common parts are computed once.
    std::vector<Field> evaluate(std::span<const Formula* const> formulas,
                                std::uint32_t stage) const;

    const SimulationDomain& domain() const;
    /// The domain in the cells of a stage, which may be wider.
    const SimulationDomain& domain(std::uint32_t stage) const;
    /// In the stage's own cells.
    const StageState& state(std::uint32_t stage) const;
    /// An item that varies, in the cells of the domain; of cells that crawl in theirs.
    const Field& field(std::uint32_t stage, ItemId item) const;
    /// The present state of a stage and of those before it, in the cells of the domain.
    StageView view(std::uint32_t stage) const;
    /// The same in the stage's own cells.
    StageView own_view(std::uint32_t stage) const;

private:
    Simulation();
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

/// The values of formulas in the first cell, in their order. It is meant for formulas that are the
/// same in all cells, such as aggregates over the domain. Formulas are evaluated together, so that
/// common parts are computed once.
std::vector<double> evaluate_numbers(const Simulation& simulation,
                                     std::span<const Formula* const> formulas, std::uint32_t stage);

/// The time since a stage began, at its present step; NaN if `speed` varies by cell.
double time_of(const Simulation& simulation, std::uint32_t stage);

/// The last stage that took a step, which pictures show; 0 if there is none.
std::uint32_t shown_stage(const Simulation& simulation);

}  // namespace cascade
