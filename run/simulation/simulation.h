// The state of a run: the values of every stage's items, and their computation.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "ir/tiered_backend.h"
#include "lang/lower/lower.h"
#include "run/domain/domain_mask.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"
#include "run/simulation/backends.h"
#include "run/simulation/stage_record.h"
#include "run/stage/step_work.h"
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
    /// Of an earlier simulation (Simulation::known_sizes); no result depends on them.
    std::map<std::string, double> known_sizes = {};
    /// The choice of operands that are written to planes. No result depends on it.
    PlanOptions planning = {Materialise::when_cheaper, false, true};
    /// The tiling; none: chosen by size and by time. No result depends on it.
    std::optional<Tiling> tiling = {};
};

/// The stepper of `options`, which simulations may share. Fails if its backend is not available.
Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options);

struct SurfaceMesh;

/// Why a stage ended.
enum class StageEnd { finished, stopped, cancelled };

class FinerView;

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
    /// interval, at tenths of its duration. If values are not finite, it fails with stage, species,
    /// cell, step and the largest stable speed.
    Result<StageEnd> advance_stage(std::uint32_t stage, std::int64_t last_step, RunControl& control,
                                   const std::function<void()>& observe, std::int64_t every = 0);

    /// A remark on a stage that has ended, in one sentence. Empty if the result is what it seems,
    /// and for a stage that has not ended.
    std::string remark_on(std::uint32_t stage) const;

    /// From now on, `is_due` is called some fifty times a second while steps are taken. If it
    /// returns true, `keep` is called at a complete step; a run can go on from the simulation's
    /// states then with the same bits. Steps on coarser grids before a stage's first step are not
    /// kept.
    void keep_with(std::function<bool()> is_due, std::function<void()> keep);

    /// Waits for code of stages that ended before it was ready, and warns of kernels that could not
    /// be compiled and were interpreted.
    void settle(RunControl& control);

    /// Makes a started stage go on from another moment. The record has all species of a stage of
    /// fields, or all values of cells that crawl; of their moment only steps and ends count.
    void restore(std::uint32_t stage, StageRecord record);

    /// The values that the start of a started stage of cells that crawl would give the present
    /// cells where they are now: by item, then in ascending order of the cells' numbers. Empty for
    /// items that the start does not compute, or that are the same in all cells. Empty altogether
    /// if the start reads cells of an earlier stage, of which cells born since have no values.
    std::vector<std::vector<double>> values_of_start(std::uint32_t stage) const;

    /// Removes the cells of a started stage of cells that crawl where `chosen`, as evaluate() gives
    /// it, is not 0. Returns the number of cells that stay; if that is 0, all were chosen, and none
    /// is removed.
    std::size_t remove_cells(std::uint32_t stage, const Field& chosen);

    /// Carries a run of the same script to the cells of this one, which are divided
    /// (DomainSettings::detail), and makes `stage` go on here until its pattern has settled (see
    /// run/simulation/finer_run.h). No stage of this simulation has started.
    Result<void> go_on_from(const Simulation& coarse, std::uint32_t stage);

    /// Ends a started stage at its present step.
    void end_stage(std::uint32_t stage);

    /// Gives a species other values, or a parameter or `frozen` that varies, in a started stage.
    /// Values outside of a mask must be 0; those of cells that crawl are where evaluate() has them;
    /// of a stage on a coarser grid they are in its own cells. What was computed from the old
    /// values when the stage started is kept: other parameters, and values of sides.
    void set_field(std::uint32_t stage, ItemId item, Field values);
    /// New values of an item, given in the cells of the domain, in those of the stage. Where they
    /// are those of field(), the stage keeps its own.
    Field in_cells_of(std::uint32_t stage, ItemId item, Field values) const;

    /// Evaluates a formula for pictures over the present state: one field, or three for a colour.
    /// Outside of the mask it is NaN, unless it is the same in all cells.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;
    /// Several formulas at once; common parts are computed once.
    std::vector<Field> evaluate(std::span<const Formula* const> formulas,
                                std::uint32_t stage) const;

    /// The present state with each cell of a plane divided into times × times; null where the
    /// domain has a mask, a surface or slices, or a stage is of cells that crawl. Throws
    /// std::bad_alloc.
    std::unique_ptr<const FinerView> finer(std::int64_t times) const;

    /// The work of one step of a started stage, as it would be taken now.
    StepWork step_work(std::uint32_t stage);

    /// The program as it runs: lengths of stages with a size are scaled.
    const Program& program() const;
    /// The same for the cells of a stage, which may lie on a coarser grid.
    const Program& program(std::uint32_t stage) const;
    /// By what lengths of stages were multiplied, under keys that say for what.
    const std::map<std::string, double>& known_sizes() const;
    const Grid& grid() const;  ///< Of the domain.
    const Grid& grid(std::uint32_t stage) const;
    /// The cells that belong to the domain; null if all do.
    const DomainMask* mask() const;
    /// The cells of the model that is the domain; null on grids.
    std::shared_ptr<const ModelCells> model() const;
    /// Bytes of all planes that it holds at one time.
    double memory() const;
    /// In the stage's own cells.
    const StageState& state(std::uint32_t stage) const;
    /// An item that varies, in the cells of the domain; of cells that crawl in theirs.
    const Field& field(std::uint32_t stage, ItemId item) const;
    /// The last stage that took a step; if there is none, the last started one; empty before.
    std::optional<std::uint32_t> shown_stage() const;
    /// The surface of the body that a stage's cells crawl on, in lengths of scripts; null without
    /// one.
    std::shared_ptr<const SurfaceMesh> body(std::uint32_t stage) const;

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

/// Did the stage itself make the pattern that is there? True if its neighbours act on each other,
/// neither random numbers nor varying parameters act on them, and every species that is not even
/// differs far more between cells than at the start of the stage.
bool made_its_pattern(const Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
