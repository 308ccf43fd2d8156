// What a simulation consists of (internal to run/simulation/simulation*.cpp).
#pragma once

#include "core/check.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "lang/calculus/lost_numbers.h"
#include "run/domain/domain_mask.h"
#include "run/domain/field_values.h"
#include "run/domain/input_files.h"
#include "run/domain/metric_planes.h"
#include "run/simulation/simulation.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/kept_tilings.h"
#include "run/stage/not_finite.h"
#include "run/stage/plan_runner.h"
#include "run/stage/result_doubts.h"
#include "run/stage/stage_plans.h"
#include "run/stage/stage_time.h"
#include "run/stage/step_kernels.h"
#include "solvers/finite.h"
#include "solvers/stability.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

/// A part of a formula that would be no number without anybody's seeing it.
struct UndefinedWatch {
    std::string where;   ///< It stands, in words.
    const char* effect;  ///< Of its being none.
    LostNumber number;
};

struct Simulation::Implementation {
    Script* script = nullptr;
    const Program* program = nullptr;
    std::unique_ptr<StagePlans> plans;
    double memory = 0;  ///< Bytes of all planes.
    Grid grid;
    int threads = 1;
    std::optional<Tiling> tiling;        ///< None: as fits.
    std::optional<KeptTilings> tilings;  ///< None on coarser grids.
    std::unique_ptr<Backend> interpreter;
    std::shared_ptr<TieredBackend> stepper;
    bool starts_interpreted = false;
    /// By stage, of those that were over before it was known whether there can be code for all.
    std::map<std::uint32_t, StepKernels> unsettled;
    bool has_expected = false;          ///< Does the stepper know what later stages need?
    std::function<bool()> keep_is_due;  ///< As keep_with has it; none: nothing is kept.
    std::function<void()> keep;
    std::unique_ptr<Team> team;
    InputFiles files;
    std::vector<Field> metric;  ///< By MetricPlane; empty without a surface.
    std::optional<DomainMask> mask;
    std::shared_ptr<const ModelCells> model;        ///< None on grids.
    std::unique_ptr<SurfaceValues> surface_values;  ///< None on grids.
    /// Values of sides follow the time of their stage whenever they are looked at.
    mutable std::vector<StageState> states;
    std::optional<Program> own_program;  ///< Of a coarser grid.
    std::string progress_note;           ///< After the stage's name in reports of progress.
    TimeAccount* account = nullptr;      ///< None where nobody asks.
    // While a stage advances:
    const RunControl* listener = nullptr;  ///< Of its warnings.
    bool undefined_is_told = false;
    mutable bool until_is_told = false;
    mutable std::optional<std::vector<UndefinedWatch>> until_watch;

    const Stage& stage(std::uint32_t k) const { return program->stages[k]; }
    const DomainMask* inside() const { return mask ? &*mask : nullptr; }
    Precision precision() const { return program->domain.precision; }

    BindingContext context(std::uint32_t stage) const {
        for (StageState& state : states) set_sides_of_now(state);
        return {states,          files,  states[stage].steps, grid,     precision(),
                states[stage].t, metric, model.get(),         inside(), surface_values.get()};
    }

    void set_sides_of_now(StageState& state) const {
        if (state.changing_sides.empty()) return;
        const FlushDenormals environment;
        const PlaneLayout layout(grid);
        for (std::size_t species = 0; species < state.sides.size(); ++species) {
            set_side_values(state.changing_sides, species, {state.steps, state.t}, layout,
                            {0, layout.row_count()}, state.sides[species]);
        }
    }

    /// Starting values and pictures.
    std::vector<Field> evaluate(const StepPlan& plan, std::uint32_t stage) const {
        return run_plan(plan, once(), context(stage), grid, *team);
    }

    Compile interpreted(const Grid& on) const {
        return [this, stencil = on.stencil()](const CellKernel& kernel) {
            auto compiled = interpreter->compile(kernel, stencil);
            CHECK(compiled, "the interpreter compiles every kernel");
            return *compiled;
        };
    }

    // What a run and its stages start with (simulation_start.cpp).

    /// Finds how much memory the run takes, and whether it may: no more than `limit` bytes, where
    /// that is above 0, and than are free.
    Result<void> check_memory(std::uint64_t limit);
    /// Of a model.
    Result<void> make_cells(const SimulationOptions& options);
    /// What formulas of the program read of places on a model.
    Result<void> make_surface_values(const SimulationOptions& options);
    /// Which cells belong to the domain: evaluated once, before any stage.
    Result<void> find_mask(const RunControl* control);
    /// Items that are the same in all cells, on a grid of one cell.
    void start_uniform_items(std::uint32_t k);
    void start_varying_items(std::uint32_t k);
    /// Values of sides are found by formulas that may read whatever the stage starts with. One that
    /// is the same everywhere is kept as a number. As long as they are looked for, the boundary of
    /// the domain holds.
    Result<void> find_sides(std::uint32_t k);
    /// Do rows and columns meet at other angles than right ones beside a side with a flux?
    bool is_sheared_at(Side side, SideKind kind) const;
    Result<void> check_speed(std::uint32_t k) const;
    /// What no step changes is computed before the first that is taken, and given back after the
    /// last.
    void find_step_invariants(std::uint32_t k);

    // Coarser grids (simulation_coarse.cpp).

    /// The simulation of stage `k` on a grid whose cells are `times` as wide, ready to be started.
    std::unique_ptr<Simulation> on_coarser_grid(std::uint32_t k, std::int64_t times) const;
    /// Runs stage `k` on its coarser grids, each from what the one before it left, and takes the
    /// species from the last.
    Result<StageEnd> run_on_coarser_grids(std::uint32_t k, RunControl& control);

    StepProblem problem(const StepPlan& plan, const Compile& compile, std::uint32_t k) const {
        return bind_plan(plan, compile, context(k), program->system_of(k), k);
    }

    bool frozen_everywhere(std::uint32_t k) const {
        const std::uint32_t item = program->system_of(k).frozen_item();
        return stage(k).uniform[item] && states[k].numbers[item] != 0;
    }

    // Kernels (simulation_kernels.cpp).

    /// Steps are compiled: before the first, or while the first ones are interpreted.
    Compile compiled(std::uint32_t k, StepKernels& kernels, RunControl& control) const;
    /// Says which kernels of stages that are behind have been refused.
    void warn_of_refused(RunControl& control);
    /// What is computed every few steps is compiled where there are many cells.
    Compile often() const;
    /// What is computed once is interpreted, unless that would take longer than making code for it.
    Compile once() const {
        return grid.cell_count() < cells_worth_compiling ? interpreted(grid) : often();
    }
    /// Has the stepper compile what stages after `k` will need, where they take long.
    void expect_later_stages(std::uint32_t k);
    /// Is it sure that the steps of a stage take longer than making code for them?
    bool is_long(std::uint32_t k) const;
    /// Are steps interpreted until there is code for them? On many cells that would take longer
    /// than to wait.
    bool runs_meanwhile() const {
        return starts_interpreted && grid.cell_count() < cells_worth_compiling;
    }
    /// Evaluating a small grid is over before code is made for it or a second thread has woken up.
    bool is_small() const { return grid.cell_count() < 65536; }

    /// Adds the present state of a stage to its course.
    void look_at(std::uint32_t k);

    /// Enters steps that were taken into the account of times.
    void account_for(std::uint32_t k, std::int64_t steps, const StageOutcome& outcome,
                     const TimeLoop& loop) const;

    /// What the time of a stage needs to know of it.
    /// `steps` makes the kernels of its steps runnable.
    StageTools tools(std::uint32_t k, Compile steps) const;

    // Why a run failed (simulation_failures.cpp).

    /// The column and row of a cell, or the number of one of a model.
    std::string place_in_words(std::int64_t column, std::int64_t row) const;
    Failure explain(const StageOutcome& outcome, std::uint32_t k);
    Failure explain(const StepTooShort& place, std::uint32_t k) const;
    StepInUse step_in_use(std::uint32_t k) const;
    /// Is the limit of the step at the present state one of diffusion, far below that of the
    /// reaction?
    bool diffusion_limits(std::uint32_t k) const;

    // Signs that a result is wrong although its values are finite (simulation_doubts.cpp).

    /// To be called at the end of a stage, before what no step changes is given back.
    void warn_of_doubts(std::uint32_t k, StageTimer& timer, RunControl& control);
    /// Are there values of which a copy can be had, and steps enough for a few more to cost little?
    bool allows_trial_steps(std::uint32_t k, StageTimer& timer) const;
    /// Takes `count` steps of a copy; `observe` sees the state before and after each. False where a
    /// value was spoiled.
    bool take_trial_steps(std::uint32_t k, StageTimer& timer, std::int64_t count,
                          const Observer& observe);
    /// Values that jump back and forth in a few more steps.
    std::optional<FlickerReport> find_flicker(std::uint32_t k, StageTimer& timer);
    /// Finds the limit of the step. Without a to and fro, changes that undo each other may be waves
    /// of a few steps: then only a step beyond the limit makes sure.
    bool is_sure(std::uint32_t k, FlickerReport& report);
    /// Values that shorter steps would lead another way.
    std::optional<AstrayReport> find_astray(std::uint32_t k, StageTimer& timer);
    /// Changes that single precision cannot add to the values, and that would have become
    /// noticeable.
    std::optional<LostChangeReport> find_lost_change(std::uint32_t k);
    /// How fast the rates decay as the state moves along them, in 1 / time; negative where they
    /// grow.
    double decay_along(std::uint32_t k, const std::vector<Field>& rates);
    /// Of the species' starting values.
    StabilityEstimate stability_at_start(std::uint32_t k);
    /// Does a species alternate from cell to cell, because of its steps or of its rate?
    std::optional<std::string> find_chequerboard(std::uint32_t k, bool flickers) const;
    /// Has a stage that has ended the values that it began with, because its rates are 0
    /// everywhere?
    bool has_stood_still(std::uint32_t k) const;

    // Values that are not numbers, and where nobody sees it (simulation_undefined.cpp).

    std::vector<UndefinedWatch> watched_in_steps(std::uint32_t k) const;
    std::vector<UndefinedWatch> watched_at_start(std::uint32_t k) const;
    std::vector<UndefinedWatch> watched_in_until(std::uint32_t k) const;
    /// Tells the first of them that is not a number now; false where there is none.
    bool warn_of_lost(std::uint32_t k, std::span<const UndefinedWatch> watched,
                      const RunControl& control) const;
    bool warn_of_undefined_parameters(std::uint32_t k, const RunControl& control) const;
    /// Before the first step of a stage, and at its end: one warning for both.
    void warn_of_undefined_start(std::uint32_t k, const RunControl& control);
    void warn_of_undefined_end(std::uint32_t k, const RunControl& control);
    /// To be called whenever `until` is looked at.
    void look_at_until(std::uint32_t k) const;
    void warn_of_undefined_mask(const RunControl& control);
    /// Pictures that a script reads and that have one level alone.
    void warn_of_even_pictures(const RunControl& control) const;

    /// The cells that count where a mask or a model says so.
    const Mask* counted() const { return mask ? &mask->inside : model ? &model->inside : nullptr; }
    StabilityEstimate stability(std::uint32_t k, std::span<const Field> species) const {
        return stability(k, species, interpreted(grid));
    }
    StabilityEstimate stability(std::uint32_t k, std::span<const Field> species,
                                const Compile& compile) const {
        // Rates know nothing of frozen cells, but those cannot blow up.
        const Mask* frozen = states[k].frozen.empty() ? nullptr : &states[k].frozen;
        const Mask still = mask ? still_cells(*mask, frozen) : Mask();
        if (mask) frozen = &still;
        return estimate_stability(problem(plan_rates(*program, k), compile, k), species, frozen);
    }
    double speed_number(std::uint32_t k) const {
        const std::uint32_t item = program->system_of(k).speed_item();
        if (states[k].time.clock.step > 0) return states[k].time.clock.step;
        return stage(k).uniform[item] ? states[k].numbers[item] : NAN;
    }
};

}  // namespace cascade
