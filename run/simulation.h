// The state of a run: the values of every stage's items, and how they come about.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "ir/tiered_backend.h"
#include "lang/lower.h"
#include "run/domain_mask.h"
#include "run/model_cells.h"
#include "run/script.h"
#include "run/stage_course.h"
#include "run/step_work.h"
#include "run/time_account.h"
#include "solvers/advance.h"
#include "solvers/changing_side.h"
#include "solvers/steady.h"

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

/// Where compiled kernels are kept: the folder that the environment variable CASCADE_KERNEL_CACHE
/// names (none if it is set and empty), else `cascade/kernels` in XDG_CACHE_HOME, else in
/// ~/.cache (XDG Base Directory Specification 0.8). Empty: nowhere, as in a home of another user.
std::filesystem::path usual_kernel_cache();

/// Values of one stage's items.
struct StageState {
    bool started = false;
    bool done = false;                  ///< All its steps are taken, or it has ended before.
    bool condition_met = false;         ///< Its `until` has ended it.
    std::int64_t steps = 0;             ///< Complete steps.
    double t = 0;                       ///< The time then; 0 where speed varies by cell.
    TimeState time;                     ///< What steps of other lengths go on from.
    SteadyWatch watch;                  ///< The last look of `until: steady(…)`.
    StageCourse course;                 ///< Since it began, or went on from a saved run.
    std::vector<double> numbers;        ///< Of the run's precision, per item; meaningful where it is uniform.
    std::vector<Field> fields;          ///< Per item; empty where uniform, and for species.
    std::vector<Field> species;         ///< In order of the species' items.
    std::vector<int> species_of_item;   ///< Per item; −1 for parameters.
    Mask frozen;                        ///< Only where `frozen` varies.
    /// What no step changes, while steps are taken (plan_lasting): planes where it varies …
    std::vector<Field> lasting;
    std::vector<double> lasting_numbers; ///< … and numbers where it does not.
    std::vector<Boundaries> lasting_boundaries;  ///< How the halo of each plane is filled.
    std::vector<SideRules> sides;       ///< By species; empty where the boundary holds for all.
    std::vector<Field> side_values;     ///< What the rules of sides point to.
    std::vector<ChangingSide> changing_sides;  ///< Those with values that change with time.

    /// The plane of an item that varies (a species or a varying parameter).
    const Field& field(std::uint32_t item) const {
        const int index = species_of_item[item];
        return index >= 0 ? species[static_cast<std::size_t>(index)] : fields[item];
    }
};

/// A state with room for all items of a system, without a plane of any.
StageState empty_state(const System& system);

/// How far a stage has come: "step 300 of 7000", "step 312, t = 4.5 of 30", or "step 312" where only
/// `until` ends it.
std::string describe_place(const Stage& stage, const StageState& state);

struct SimulationOptions {
    BackendKind backend = BackendKind::jit;
    int lanes = 0;      ///< Vector width of the JIT; 0 takes the host's.
    int threads = 0;    ///< 0 takes all the machine has.
    /// Takes the steps of several simulations, so that equal kernels are compiled once; none: each
    /// simulation has one of its own.
    std::shared_ptr<TieredBackend> stepper = nullptr;
    /// Hears how the cells of a model come about, and may stop it; none: nobody does.
    RunControl* control = nullptr;
    TimeAccount* account = nullptr;   ///< Is told where the time goes; none: nobody is.
    std::filesystem::path cell_cache = {};  ///< A folder in which cells of models are kept; empty: none.
    /// A folder in which compiled kernels, and what is found about tilings, are kept for later processes;
    /// empty: none.
    std::filesystem::path kernel_cache = {};
    /// Take steps while code for them is made? Their first ones are interpreted then, unless there are so
    /// many cells that waiting is quicker. No result depends on it, but how long a step takes does.
    bool starts_interpreted = false;
    std::uint64_t memory_limit = 0;   ///< Bytes that all fields may take; 0: what is free.
    /// How steps are put together. No result depends on it.
    PlanOptions planning = {Bringing::cheaper, false, true};
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

    /// Takes steps until `last_step` are complete. A stage that starts on coarser grids is run on
    /// those before its first step, without being observed. `observe` is called at multiples of
    /// `every`, or, where that is 0, of the stage's interval; and at tenths of the duration of a stage
    /// without one. Fails, with stage, species, cell, step and the largest stable speed, on values
    /// that are not finite.
    Result<StageEnd> advance_stage(std::uint32_t stage, std::int64_t last_step,
                                   RunControl& control, const std::function<void()>& observe,
                                   std::int64_t every = 0);

    /// What is to be said of a stage that has ended, in one sentence; empty where all is as one would
    /// think, and of a stage that has not ended.
    std::string remark_on(std::uint32_t stage) const;

    /// From now on, while steps are taken: where `is_due` says so, which is asked some fifty times a second,
    /// `keep` is called at a complete step, and the simulation's states are what a run can go on from with
    /// the same bits. What is done on coarser grids before a stage's first step is not kept.
    void keep_with(std::function<bool()> is_due, std::function<void()> keep);

    /// Waits for code that is being made for stages that were over before it was there, and says of which
    /// there is none, so that they were interpreted.
    void settle(RunControl& control);

    /// Replaces the species of a started stage (resume, the prompt's :load).
    void set_species(std::uint32_t stage, std::vector<Field> species, std::int64_t steps,
                     bool done, bool condition_met = false);

    /// Sets the time of a stage whose species were replaced; without it its steps are taken as of
    /// the stage's speed.
    void set_time(std::uint32_t stage, double t, const TimeState& time, SteadyWatch watch);

    /// A formula for pictures over the present state: one field, or three for a colour. Outside of
    /// the mask it is NaN, unless it is the same in all cells.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;
    /// Several formulas at once: what they share is computed once.
    std::vector<Field> evaluate(std::span<const Formula* const> formulas,
                                std::uint32_t stage) const;
    /// Formulas that are the same in all cells, such as aggregates over the domain (of others the
    /// first cell's value).
    std::vector<double> evaluate_numbers(std::span<const Formula* const> formulas,
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
    /// The time since a stage began, at its present step; NaN where `speed` differs between cells.
    double time(std::uint32_t stage) const;
    /// The last stage that took a step; the last started one where none has; empty before.
    std::optional<std::uint32_t> shown_stage() const;

private:
    Simulation();
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
