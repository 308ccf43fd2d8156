// Runs the stages of a script and holds the values of their items.
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
    std::string_view backend = fastest_backend().name;  ///< A name in the table of backends.
    int lanes = 0;                                      ///< See BackendOptions.
    int threads = 0;                                    ///< 0: as many threads as the machine has.
    /// Makes the executor that takes the steps of stages of fields. No result depends on it.
    MakeExecutor executor = make_thread_executor;
    /// Compiles the steps of several simulations, so that equal kernels are compiled only once. If
    /// null, each simulation makes its own compiler.
    std::shared_ptr<TieredBackend> stepper = nullptr;
    /// Receives the progress while the cells of a model are made, and may cancel this work. May be
    /// null.
    RunControl* control = nullptr;
    /// Called with the model before its cells are made. May refuse the model. May be empty.
    std::function<Result<void>(const SurfaceMesh&)> check_model = {};
    /// The largest number of seconds for making the cells of a model. If they take longer, the
    /// model is refused. 0: no limit.
    double model_seconds = 0;
    /// Receives the times that parts of the run take. May be null.
    TimeAccount* account = nullptr;
    /// The folder in which cells of models are stored. If empty, they are not stored.
    std::filesystem::path cell_cache = {};
    /// The folder in which compiled kernels and the fastest tilings are stored for later processes.
    /// If empty, they are not stored.
    std::filesystem::path kernel_cache = {};
    /// Whether the first steps are interpreted while their code is compiled. On large grids the
    /// steps wait for their code even if this is true, because that is faster. No result depends on
    /// it.
    bool starts_interpreted = false;
    /// The largest number of bytes for all fields. 0: all free memory.
    std::uint64_t memory_limit = 0;
    /// The cells of the script's model, if another simulation has made them. Otherwise null.
    std::shared_ptr<const ModelCells> known_model = nullptr;
    /// The factors that an earlier simulation found for sizes (SimulationDomain::known_sizes). No
    /// result depends on them.
    std::map<std::string, double> known_sizes = {};
    /// The rule by which plans choose the operands that are written to planes. No result depends on
    /// it.
    PlanOptions planning = {Materialise::when_cheaper, false, true};
    /// The tiling of planes. If empty, it is chosen by the size of the grid and by measurement. No
    /// result depends on it.
    std::optional<Tiling> tiling = {};
};

/// Makes the stepper that `options` describe, which simulations may share. Fails if its backend is
/// not available.
Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options);

/// Returns the first moment after `t` at which a stage must be observed. Both are times since the
/// stage began. Returns infinity if there is no such moment.
using NextMoment = std::function<double(double t)>;

/// The reason why advance_stage() ended.
enum class StageEnd { finished, stopped, cancelled };

class StageView;

/// Runs the stages of a checked program one after the other. Owns all fields.
class Simulation {
public:
    /// Checks memory and reads the files that the script names. If a file has errors, adds them to
    /// `script.diagnostics` and fails. `script` must outlive the simulation.
    static Result<std::unique_ptr<Simulation>> create(Script& script,
                                                      const SimulationOptions& options);
    ~Simulation();

    /// Computes the starting values of a stage from earlier stages. Fails if `speed` is not above 0
    /// or a starting value is not finite. Making a grown body takes long. If `cancel` becomes true
    /// while a body is made, the call fails and the stage is not started.
    Result<void> start_stage(std::uint32_t stage,
                             const std::atomic<bool>& cancel = never_cancelled);

    /// Takes steps until `last_step` steps are complete. The first call allocates the memory for
    /// steps. This memory is kept for further calls until the stage ends or states are changed. A
    /// stage with a coarse start first runs on coarser grids, without observation. `observe` is
    /// called at multiples of `every` steps. If `every` is 0, it is called at the stage's interval.
    /// If the stage has no interval, `observe` is called at multiples of the time that the stage's
    /// setting `every` gives, or at tenths of the duration if there is no such setting. If
    /// `next_moment` is given, `observe` is called only at its moments, with values interpolated
    /// between steps (run/simulation/between_steps.h, tissue/tissue_moments.h). In a stage of
    /// fields this requires a uniform `speed`. If values are not finite, the call fails and names
    /// stage, species, cell, step and the largest stable speed.
    Result<StageEnd> advance_stage(std::uint32_t stage, std::int64_t last_step, RunControl& control,
                                   const std::function<void()>& observe, std::int64_t every = 0,
                                   const NextMoment& next_moment = {});

    /// From now on, calls `is_due` about fifty times a second while steps are taken. If `is_due`
    /// returns true, calls `keep` after the next complete step. A run that continues from the
    /// states at that moment gives the same result, bit for bit. While a stage runs on coarser
    /// grids before its first step, nothing is saved.
    void keep_with(std::function<bool()> is_due, std::function<void()> keep);

    /// Waits for compiled code that was not ready when its stage ended. Warns of kernels that were
    /// interpreted because they could not be compiled.
    void settle(RunControl& control);

    /// Changes the state of a started stage between two steps, in the stage's own cells. Some
    /// values were computed from the old state at the start of the stage, such as other parameters
    /// and values at sides. They stay as they are.
    void change_stage(std::uint32_t stage, const std::function<void(StageState&)>& change);

    /// Transfers a run of the same script to the divided cells of this simulation
    /// (DomainSettings::detail), and lets `stage` continue here until its pattern has settled
    /// (run/simulation/finer_run.h). No stage of this simulation may have started.
    Result<void> go_on_from(const Simulation& coarse, std::uint32_t stage);

    /// Evaluates a formula for pictures at the present state. Returns one field, or three for a
    /// colour. Values outside the mask are NaN unless the formula is uniform.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;
    /// Evaluates several formulas together, so that common parts are computed once.
    std::vector<Field> evaluate(std::span<const Formula* const> formulas,
                                std::uint32_t stage) const;

    const SimulationDomain& domain() const;
    /// Returns the domain in the cells of a stage, which may be larger than the script's cells.
    const SimulationDomain& domain(std::uint32_t stage) const;
    /// Returns the state of a stage in the stage's own cells.
    const StageState& state(std::uint32_t stage) const;
    /// Returns the values of an item that varies. There is a value for each cell of the domain's
    /// grid or, in a stage of crawling cells, for each crawling cell.
    const Field& field(std::uint32_t stage, ItemId item) const;
    /// Returns the present state of a stage and of all stages before it, in the cells of the
    /// domain.
    StageView view(std::uint32_t stage) const;
    /// Returns the present state of a stage and of all stages before it, in the stage's own cells.
    StageView own_view(std::uint32_t stage) const;

private:
    Simulation();
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

/// Evaluates formulas in the first cell. Returns the values in the order of the formulas. This is
/// meant for formulas with the same value in all cells, such as aggregates. Common parts are
/// computed once.
std::vector<double> evaluate_numbers(const Simulation& simulation,
                                     std::span<const Formula* const> formulas, std::uint32_t stage);

/// Returns the time from the beginning of a stage to its present step, or NaN if `speed` varies.
double time_of(const Simulation& simulation, std::uint32_t stage);

/// Returns the last stage that has taken a step, which pictures show by default. Returns 0 if no
/// stage has taken a step.
std::uint32_t shown_stage(const Simulation& simulation);

}  // namespace cascade
