// The state of a run: the values of every stage's items, and how they come about.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "ir/tiered_backend.h"
#include "lang/lower/lower.h"
#include "run/domain/domain_mask.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"
#include "run/stage/stage_state.h"
#include "run/stage/step_work.h"
#include "run/stage/time_account.h"
#include "solvers/advance.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

enum class BackendKind { interpreter, jit };

/// Is native code compiled into this build?
bool has_jit();
/// What takes the steps: LLVM's version, the processor and its vectors, or the interpreter alone.
std::string describe_backend();

struct SimulationOptions {
    BackendKind backend = BackendKind::jit;
    int lanes = 0;    ///< Vector width of the JIT; 0 takes the host's.
    int threads = 0;  ///< 0 takes all the machine has.
    /// Takes the steps of several simulations, so that equal kernels are compiled once; none: each
    /// simulation has one of its own.
    std::shared_ptr<TieredBackend> stepper = nullptr;
    /// Hears how the cells of a model come about, and may stop it; none: nobody does.
    RunControl* control = nullptr;
    TimeAccount* account = nullptr;  ///< Receives the times spent; may be null.
    std::filesystem::path cell_cache =
        {};  ///< A folder in which cells of models are kept; empty: none.
    /// A folder in which compiled kernels, and what is found about tilings, are kept for later
    /// processes; empty: none.
    std::filesystem::path kernel_cache = {};
    /// Interpret the first steps while their code is compiled, unless the grid is so large that
    /// waiting for the code is quicker. Affects the time of a step, but no result.
    bool starts_interpreted = false;
    std::uint64_t memory_limit = 0;  ///< Bytes that all fields may take; 0: what is free.
    /// How steps are put together. No result depends on it.
    PlanOptions planning = {Materialise::when_cheaper, false, true};
    /// How steps go through memory; none: as fits the machine's caches. No result depends on it.
    std::optional<Tiling> tiling = {};
};

/// What `options` ask for, to be shared by simulations. Fails where this build has no native code.
Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options);

/// Why a stage ended.
enum class StageEnd { finished, stopped, cancelled };

/// Runs the stages of a checked program, one after the other. Owns all fields.
class Simulation {
public:
    /// Checks memory and reads the files that the script names. Faults of such files are added to
    /// `script.diagnostics` (and the result fails). `script` must outlive the simulation.
    static Result<std::unique_ptr<Simulation>> create(Script& script,
                                                      const SimulationOptions& options);
    ~Simulation();

    /// Computes the starting values of a stage from the earlier ones. Fails if `speed` is not
    /// above 0 or a starting value is not finite.
    Result<void> start_stage(std::uint32_t stage);

    /// Takes steps until `last_step` are complete. What they take is made by the first call and
    /// kept for the next ones, until the stage ends or states are changed. A stage that starts on
    /// coarser grids is run on those before its first step, without being observed. `observe` is
    /// called at multiples of `every`, or, where that is 0, of the stage's interval; and at tenths
    /// of the duration of a stage without one. Fails, with stage, species, cell, step and the
    /// largest stable speed, on values that are not finite.
    Result<StageEnd> advance_stage(std::uint32_t stage, std::int64_t last_step, RunControl& control,
                                   const std::function<void()>& observe, std::int64_t every = 0);

    /// What is to be said of a stage that has ended, in one sentence; empty where all is as one
    /// would think, and of a stage that has not ended.
    std::string remark_on(std::uint32_t stage) const;

    /// From now on, while steps are taken: where `is_due` says so, which is asked some fifty times
    /// a second, `keep` is called at a complete step, and the simulation's states are what a run
    /// can go on from with the same bits. What is done on coarser grids before a stage's first step
    /// is not kept.
    void keep_with(std::function<bool()> is_due, std::function<void()> keep);

    /// Waits for code that is being made for stages that were over before it was there, and says of
    /// which there is none, so that they were interpreted.
    void settle(RunControl& control);

    /// Replaces the species of a started stage (resume, the prompt's :load).
    void set_species(std::uint32_t stage, std::vector<Field> species, std::int64_t steps, bool done,
                     bool condition_met = false);

    /// Sets the time of a stage whose species were replaced; without it its steps are taken as of
    /// the stage's speed.
    void set_time(std::uint32_t stage, double t, const TimeState& time, SteadyWatch watch);

    /// A formula for pictures over the present state: one field, or three for a colour. Outside of
    /// the mask it is NaN, unless it is the same in all cells.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;
    /// Several formulas at once: what they share is computed once.
    std::vector<Field> evaluate(std::span<const Formula* const> formulas,
                                std::uint32_t stage) const;

    /// What one step of a started stage costs, as it would be taken now.
    StepWork step_work(std::uint32_t stage);

    const Program& program() const;
    const Grid& grid() const;
    /// The cells that belong to the domain; nullptr where all do.
    const DomainMask* mask() const;
    /// The cells of the model that is the domain; nullptr on grids.
    std::shared_ptr<const ModelCells> model() const;
    /// Bytes of all planes that it keeps at one time.
    double memory() const;
    const StageState& state(std::uint32_t stage) const;
    /// The last stage that took a step; the last started one where none has; empty before.
    std::optional<std::uint32_t> shown_stage() const;

private:
    Simulation();
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

/// The values of formulas that are the same in all cells, such as aggregates over the domain (of
/// others the first cell's).
std::vector<double> evaluate_numbers(const Simulation& simulation,
                                     std::span<const Formula* const> formulas, std::uint32_t stage);

/// The time since a stage began, at its present step; NaN where `speed` differs between cells.
double time_of(const Simulation& simulation, std::uint32_t stage);

/// Is the pattern there is the stage's own work? Its neighbours act on each other, no chance and no
/// parameter that varies acts on them, and every species that is not even differs far more between
/// cells than when the stage began.
bool made_its_pattern(const Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
