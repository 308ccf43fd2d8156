#include "run/simulation.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "ir/interpreter.h"
#include "run/bind_side.h"
#include "run/bound_diffusion.h"
#include "run/bound_kernel.h"
#include "run/coarse_start.h"
#include "run/input_files.h"
#include "run/memory.h"
#include "run/metric_planes.h"
#include "run/not_finite.h"
#include "run/stage_plans.h"
#include "run/stage_time.h"
#include "solvers/stability.h"
#if CASCADE_HAS_JIT
#include "jit/jit.h"
#endif

#include <fmt/format.h>

#include <cmath>

namespace cascade {

bool has_jit() { return CASCADE_HAS_JIT; }

std::string describe_place(const Stage& stage, const StageState& state) {
    const std::string step = fmt::format("step {}", state.steps);
    if (stage.time.open_end) return step;
    if (!stage.time.has_duration()) return fmt::format("{} of {}", step, stage.iterations);
    if (!stage.time.duration) return fmt::format("{}, t = {:.6g}", step, state.t);
    return fmt::format("{}, t = {:.6g} of {:.6g}", step, state.t, *stage.time.duration);
}

std::string describe_backend() {
#if CASCADE_HAS_JIT
    return "native code by " + describe_jit();
#else
    return "interpreter only, without LLVM";
#endif
}

StageState empty_state(const System& system) {
    StageState state;
    state.numbers.assign(system.item_count(), 0);
    state.fields.resize(system.item_count());
    state.species_of_item.assign(system.item_count(), -1);
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item)) continue;
        state.species_of_item[item] = static_cast<int>(state.species.size());
        state.species.emplace_back();
    }
    return state;
}

Result<std::shared_ptr<Backend>> make_stepper(const SimulationOptions& options) {
    if (options.backend == BackendKind::interpreter) return make_interpreter();
#if CASCADE_HAS_JIT
    JitOptions jit;
    jit.lanes = options.lanes;
    return make_jit(jit);
#else
    return failure("this build has no native compiler", "use --backend interp");
#endif
}

struct Simulation::Implementation {
    Script* script = nullptr;
    const Program* program = nullptr;
    std::unique_ptr<StagePlans> plans;
    double memory = 0;  ///< Bytes of all planes.
    Grid grid;
    int threads = 1;
    std::unique_ptr<Backend> interpreter;
    std::shared_ptr<Backend> stepper;
    std::unique_ptr<Team> team;
    InputFiles files;
    std::vector<Field> metric;  ///< By MetricPlane; empty without a surface.
    std::optional<DomainMask> mask;
    /// Values of sides follow the time of their stage whenever they are looked at.
    mutable std::vector<StageState> states;
    std::optional<Program> own_program;  ///< Of a coarser grid.
    std::string progress_note;           ///< Behind the stage's name in reports of progress.

    const Stage& stage(std::uint32_t k) const { return program->stages[k]; }
    const DomainMask* inside() const { return mask ? &*mask : nullptr; }
    Result<void> find_mask();
    Precision precision() const { return program->domain.precision; }

    BindingContext context(std::uint32_t stage) const {
        for (StageState& state : states) set_sides_of_now(state);
        return {states, files, states[stage].steps, grid, precision(), states[stage].t, metric,
                inside()};
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

    /// Starting values need no compiling and pictures neither: both are interpreted.
    std::vector<Field> evaluate(const StepPlan& plan, std::uint32_t stage) const {
        return run_plan(plan, interpreted(grid), context(stage), grid, *team);
    }

    Compile interpreted(const Grid& on) const {
        return [this, stencil = on.stencil()](const CellKernel& kernel) {
            auto compiled = interpreter->compile(kernel, stencil);
            CHECK(compiled, "the interpreter compiles every kernel");
            return *compiled;
        };
    }

    void start_uniform_items(std::uint32_t k) {
        const StepPlan plan = plan_uniform_start(*program, k);
        const Grid one{1, 1, Boundary::periodic};
        const std::vector<Field> values = run_plan(plan, interpreted(one), context(k), one, *team);
        for (std::size_t r = 0; r < values.size(); ++r) {
            states[k].numbers[plan.results[r]] = values[r].number_at(0, 0);
        }
    }

    void start_varying_items(std::uint32_t k) {
        const StepPlan& plan = plans->start(k);
        std::vector<Field> values = evaluate(plan, k);
        StageState& state = states[k];
        const System& system = program->system_of(k);
        for (std::size_t r = 0; r < values.size(); ++r) {
            const std::uint32_t item = plan.results[r];
            const int species = state.species_of_item[item];
            if (stage(k).uniform[item]) {
                state.numbers[item] = values[r].number_at(0, 0);
            } else if (species >= 0) {
                state.species[static_cast<std::size_t>(species)] = std::move(values[r]);
            } else {
                if (item == system.frozen_item()) state.frozen = to_mask(values[r]);
                state.fields[item] = std::move(values[r]);
            }
        }
    }

    Result<void> find_sides(std::uint32_t k);

    /// Do rows and columns meet at other angles than right ones beside a side with a flux?
    bool is_sheared_at(Side side, SideKind kind) const {
        if (metric.empty() || kind != SideKind::flux) return false;
        const auto at = [&](MetricPlane plane, std::int64_t offset) {
            return metric[static_cast<std::size_t>(plane)].visit(
                [&](const auto& cells) { return double{cells.origin()[offset]}; });
        };
        const PlaneLayout layout(grid);
        const SideCells cells = SideCells::of_rows(layout, side, {0, layout.row_count()});
        for (std::int64_t k = 0; k < cells.count; ++k) {
            const std::int64_t offset = SideCells::offset(layout, side, k);
            const double across = std::abs(at(MetricPlane::inverse_12, offset));
            if (across > 1e-3 * std::abs(at(MetricPlane::inverse_22, offset))) return true;
        }
        return false;
    }

    /// What no step changes is computed before the first that is taken, and given back behind the
    /// last.
    void find_lasting_parts(std::uint32_t k) {
        const StepPlan& once = plans->lasting(k);
        StageState& state = states[k];
        state.lasting.clear();
        state.lasting_numbers.assign(once.result_count, 0);
        state.lasting_boundaries.resize(once.result_count);
        if (once.result_count == 0) return;
        state.lasting = evaluate(once, k);
        for (const PassTarget& target : once.passes.back().targets) {
            if (target.kind != PassTarget::Kind::result) continue;
            state.lasting_boundaries[target.index] = target.boundary;
            if (!target.is_uniform) continue;
            Field& plane = state.lasting[target.index];
            state.lasting_numbers[target.index] = plane.number_at(0, 0);
            plane = {};
        }
    }

    Result<void> check_speed(std::uint32_t k) const {
        const System& system = program->system_of(k);
        const std::uint32_t item = system.speed_item();
        double slowest = states[k].numbers[item];
        if (!stage(k).uniform[item]) slowest = smallest(states[k].fields[item], inside());
        if (slowest > 0 && std::isfinite(slowest)) return {};
        const std::string text = with_number(precision(), [&](auto zero) {
            return fmt::format("{}", static_cast<decltype(zero)>(slowest));
        });
        return failure(fmt::format("stage '{}': its speed is {}, but a time step must be above 0",
                                   stage(k).name, text));
    }

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

    /// Steps are compiled.
    Compile compiled(RunControl& control, const std::string& name) const {
        return [this, &control, &name](const CellKernel& kernel) {
            auto made = stepper->compile(kernel, grid.stencil());
            if (made) return *made;
            if (control.warn) {
                control.warn(fmt::format("stage '{}' is interpreted, which is slow: {}", name,
                                         made.error().message));
            }
            return *interpreter->compile(kernel, grid.stencil());
        };
    }

    /// What is computed every few steps is compiled where there are many cells.
    Compile often() const {
        if (is_small()) return interpreted(grid);
        return [this, interpret = interpreted(grid)](const CellKernel& kernel) {
            auto made = stepper->compile(kernel, grid.stencil());
            return made ? *made : interpret(kernel);
        };
    }
    /// Evaluating a small grid is over before code is made for it or a second thread has woken up.
    bool is_small() const { return grid.cell_count() < 65536; }

    /// What the time of a stage needs to know of it.
    StageTools tools(std::uint32_t k, RunControl& control) const;
    Failure explain(const StageOutcome& outcome, std::uint32_t k);
    Failure explain(const StepTooShort& place, std::uint32_t k) const;
    void warn_of_chequerboard(std::uint32_t k, RunControl& control) const;
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

Simulation::Simulation() : self_(std::make_unique<Implementation>()) {}
Simulation::~Simulation() = default;

Result<std::unique_ptr<Simulation>> Simulation::create(Script& script,
                                                       const SimulationOptions& options) {
    CHECK(script.program, "only a checked script is simulated");
    std::unique_ptr<Simulation> simulation(new Simulation);
    Implementation& self = *simulation->self_;
    self.script = &script;
    self.program = &*script.program;
    self.grid = self.program->domain.grid;
    self.threads = options.threads > 0 ? options.threads : hardware_threads();

    self.plans = std::make_unique<StagePlans>(*self.program, options.planning);
    self.memory = memory_of(*self.program, *self.plans);
    if (auto enough = check_memory(self.grid, self.memory, options.memory_limit); !enough) {
        return tl::unexpected(enough.error());
    }
    auto files = read_input_files(script);
    if (!files) return tl::unexpected(files.error());
    self.files = std::move(*files);
    auto metric = metric_planes(*self.program);
    if (!metric) return tl::unexpected(metric.error());
    self.metric = std::move(*metric);

    self.interpreter = make_interpreter();
    self.stepper = options.stepper;
    if (!self.stepper) {
        auto stepper = make_stepper(options);
        if (!stepper) return tl::unexpected(stepper.error());
        self.stepper = std::move(*stepper);
    }
    self.team = std::make_unique<Team>(self.is_small() ? 1 : self.threads);
    self.states.resize(self.program->stages.size());
    if (auto found = self.find_mask(); !found) return tl::unexpected(found.error());
    return simulation;
}

Result<void> Simulation::start_stage(std::uint32_t k) {
    Implementation& self = *self_;
    const System& system = self.program->system_of(k);
    StageState& state = self.states[k];
    state = empty_state(system);
    self.start_uniform_items(k);
    self.start_varying_items(k);
    if (auto sides = self.find_sides(k); !sides) return sides;
    state.started = true;
    return self.check_speed(k);
}

Result<StageEnd> Simulation::advance_stage(std::uint32_t k, std::int64_t last_step,
                                           RunControl& control,
                                           const std::function<void()>& observe,
                                           std::int64_t every) {
    Implementation& self = *self_;
    StageState& state = self.states[k];
    const Stage& stage = self.stage(k);
    CHECK(state.started, "a stage is started before it advances");

    StageTimer timer(*self.program, k, state, self.tools(k, control));
    // Nothing moves where everything is frozen: its steps are complete as they begin.
    if (self.frozen_everywhere(k)) {
        state.steps = stage.time.has_duration() ? 0 : last_step;
        state.done = stage.time.has_duration() || state.steps >= stage.iterations;
        return state.done ? StageEnd::finished : StageEnd::stopped;
    }
    if (state.steps == 0 && last_step > 0 && stage.time.coarse > 1) {
        auto grown = self.run_on_coarser_grids(k, control);
        if (!grown || *grown == StageEnd::cancelled) return grown;
    }
    self.find_lasting_parts(k);
    Progress progress;
    progress.stage = stage.name;
    progress.note = self.progress_note;
    progress.stage_number = static_cast<int>(k) + 1;
    progress.stage_count = static_cast<int>(self.script->stage_count());
    progress.steps = stage.iterations;
    Schedule schedule = timer.schedule(last_step, every > 0 ? every : stage.interval);
    schedule.tenths = stage.interval == 0;
    schedule.threads = self.threads;
    const StageOutcome outcome = advance(timer.problem(), schedule, state.species, control, progress,
                                         [&](std::int64_t step, double t, std::span<const Field>) {
                                             state.steps = step;
                                             state.t = t;
                                             if (observe) observe();
                                             return true;
                                         });
    state.lasting.clear();
    state.steps = outcome.steps;
    state.t = outcome.t;
    state.time = outcome.time;
    if (outcome.not_finite) return tl::unexpected(self.explain(outcome, k));
    if (outcome.too_short) return tl::unexpected(self.explain(*outcome.too_short, k));
    self.warn_of_chequerboard(k, control);
    if (outcome.cancelled) return StageEnd::cancelled;
    state.done = outcome.ended || state.steps >= stage.iterations;
    if (stage.time.open_end && !outcome.ended && state.done && control.warn) {
        control.warn(fmt::format("stage '{}' took {} steps and 'until' has not ended it", stage.name,
                                 state.steps));
    }
    return state.done ? StageEnd::finished : StageEnd::stopped;
}

std::unique_ptr<Simulation> Simulation::Implementation::on_coarser_grid(
    std::uint32_t k, std::int64_t times) const {
    std::unique_ptr<Simulation> simulation(new Simulation);
    Implementation& coarse = *simulation->self_;
    coarse.script = script;
    coarse.own_program = cascade::on_coarser_grid(*program, k, times);
    coarse.program = &*coarse.own_program;
    coarse.plans = std::make_unique<StagePlans>(*coarse.program, plans->options());
    coarse.grid = coarse.program->domain.grid;
    coarse.threads = threads;
    coarse.interpreter = make_interpreter();
    coarse.stepper = stepper;
    coarse.team = std::make_unique<Team>(1);
    coarse.files = restricted(files, grid, coarse.grid);
    coarse.states.resize(states.size());
    for (std::uint32_t earlier = 0; earlier < k; ++earlier) {
        coarse.states[earlier] = restricted(states[earlier], grid, coarse.grid);
    }
    coarse.progress_note = fmt::format(", cells {} times as wide", times);
    return simulation;
}

Result<StageEnd> Simulation::Implementation::run_on_coarser_grids(std::uint32_t k,
                                                                  RunControl& control) {
    std::unique_ptr<Simulation> before;
    for (std::int64_t times = stage(k).time.coarse; times > 1; times /= 2) {
        std::unique_ptr<Simulation> coarse = on_coarser_grid(k, times);
        const auto note = [&](Failure failure) {
            failure.message += fmt::format(" (on the grid with cells {} times as wide)", times);
            return tl::unexpected(std::move(failure));
        };
        if (auto started = coarse->start_stage(k); !started) return note(started.error());
        if (before) {
            take_refined(coarse->self_->states[k], coarse->grid(), before->self_->states[k],
                         before->grid());
        }
        auto end = coarse->advance_stage(k, coarse->program().stages[k].iterations, control, {});
        if (!end) return note(end.error());
        if (*end == StageEnd::cancelled) return end;
        before = std::move(coarse);
    }
    take_refined(states[k], grid, before->self_->states[k], before->grid());
    return StageEnd::finished;
}

void Simulation::set_species(std::uint32_t stage, std::vector<Field> species, std::int64_t steps,
                             bool done) {
    StageState& state = self_->states[stage];
    CHECK(species.size() == state.species.size(), "every species of the stage is given");
    state.species = std::move(species);
    state.steps = steps;
    state.done = done;
}

void Simulation::set_time(std::uint32_t stage, double t, const TimeState& time,
                          SteadyWatch watch) {
    StageState& state = self_->states[stage];
    state.t = t;
    state.time = time;
    state.watch = std::move(watch);
}

std::vector<Field> Simulation::evaluate(const Formula& formula, std::uint32_t stage) const {
    return self_->evaluate(plan_view(*self_->program, formula, stage), stage);
}

std::vector<Field> Simulation::evaluate(std::span<const Formula* const> formulas,
                                        std::uint32_t stage) const {
    return self_->evaluate(plan_view(*self_->program, formulas, stage), stage);
}

std::vector<double> Simulation::evaluate_numbers(std::span<const Formula* const> formulas,
                                                std::uint32_t stage) const {
    std::vector<double> numbers;
    for (const Field& field : evaluate(formulas, stage)) numbers.push_back(field.number_at(0, 0));
    return numbers;
}

const Program& Simulation::program() const { return *self_->program; }
const Grid& Simulation::grid() const { return self_->grid; }
const DomainMask* Simulation::mask() const { return self_->inside(); }
double Simulation::memory() const { return self_->memory; }
const StageState& Simulation::state(std::uint32_t stage) const { return self_->states[stage]; }

double Simulation::time(std::uint32_t stage) const {
    const StageState& state = self_->states[stage];
    const bool is_timed = self_->program->stages[stage].uniform[self_->program->system_of(stage).speed_item()];
    return is_timed ? state.t : NAN;
}

std::optional<std::uint32_t> Simulation::shown_stage() const {
    std::optional<std::uint32_t> shown;
    for (std::uint32_t k = 0; k < self_->states.size(); ++k) {
        if (self_->states[k].started && !shown) shown = k;
        if (self_->states[k].started && self_->states[k].steps > 0) shown = k;
    }
    return shown;
}

StageTools Simulation::Implementation::tools(std::uint32_t k, RunControl& control) const {
    StageTools tools;
    tools.numbers = [this, k](std::span<const Formula* const> formulas) {
        return [this, k, plan = plan_view(*program, formulas, k), compile = often()] {
            std::vector<double> numbers;
            for (const Field& field : run_plan(plan, compile, context(k), grid, *team)) {
                numbers.push_back(field.number_at(0, 0));
            }
            return numbers;
        };
    };
    const auto largest = [this, k](std::span<const Formula* const> formulas) {
        std::vector<double> values;
        for (const Field& field : evaluate(plan_view(*program, formulas, k), k)) {
            values.push_back(largest_value(field, inside()));
        }
        return values;
    };
    tools.bind = [this, k, &control, largest](const Scheme& scheme) {
        std::vector<StepPlan> sweeps;
        for (const SweepForm& form : scheme.forms) sweeps.push_back(plans->sweep(k, form));
        const auto bind = [&](const StepPlan& before) {
            return bind_scheme(scheme, sweeps, before, compiled(control, stage(k).name), context(k),
                               program->system_of(k), k);
        };
        if (!is_semi_implicit(stage(k).time.solver)) return bind({});
        const BoundDiffusion diffusion(*program, k, largest);
        StepProblem problem = bind(diffusion.before());
        diffusion.add_to(problem);
        return problem;
    };
    tools.inside = mask ? &mask->inside : nullptr;
    tools.is_true = [this, k](const Formula& formula) {
        return evaluate(plan_view(*program, formula, k), k)[0].number_at(0, 0) != 0;
    };
    tools.estimate = [this, k, compile = often()] {
        const auto limit = stability(k, states[k].species, compile).largest_speed;
        return limit ? 2 / *limit : 0;
    };
    return tools;
}

Failure Simulation::Implementation::explain(const StepTooShort& place, std::uint32_t k) const {
    Failure failure;
    failure.message = fmt::format(
        "stage '{}' ({}): steps shrink to nothing: at t = {:.6g} one of {:.2g} is too long still, for "
        "{} at column {}, row {}",
        stage(k).name, program->system_of(k).name, place.t, place.step,
        species_name(program->system_of(k), place.species), place.column, place.row);
    failure.hint = "something jumps or grows without bound there; a larger tolerance or euler may pass it";
    return failure;
}

/// The mask is evaluated once, before any stage.
Result<void> Simulation::Implementation::find_mask() {
    if (!program->domain.mask || states.empty()) return {};
    const std::vector<Field> values =
        run_plan(plan_mask(*program), interpreted(grid), context(0), grid, *team);
    mask = make_domain_mask(values[0], grid);
    if (mask->cells > 0) return {};
    script->diagnostics.error(program->domain.mask->span, "no cell is inside the mask",
                              "cells where it is not 0 belong to the domain");
    return failure("the domain has no cells");
}

/// Values of sides are found by formulas that may read whatever the stage starts with. One that is
/// the same everywhere is kept as a number. As long as they are looked for, the boundary of the
/// domain holds.
Result<void> Simulation::Implementation::find_sides(std::uint32_t k) {
    StageState& state = states[k];
    std::vector<SideRules> found;
    std::vector<ChangingSide> changing_sides;
    for (const auto& settings : stage(k).sides) {
        const auto species = static_cast<std::uint32_t>(found.size());
        SideRules rules;
        rules.spacing = grid.spacing;
        for (std::size_t side = 0; side < side_count; ++side) rules.at[side].kind = settings[side].kind;
        for (std::size_t side = 0; side < side_count; ++side) {
            SideRule& rule = rules.at[side];
            if (!rule.has_value()) continue;
            const SidePlans value = plan_side(*program, settings[side], static_cast<Side>(side), k);
            if (is_sheared_at(static_cast<Side>(side), rule.kind)) {
                return failure(
                    fmt::format("stage '{}': {} has a flux at the side {}, where the surface is sheared",
                                stage(k).name, species_name(program->system_of(k), species),
                                side_names[side]),
                    "a flux needs rows and columns that meet at right angles; fixed(…) does not");
            }
            if (value.changes) {
                ChangingSide changing = bind_side(value, species, static_cast<Side>(side),
                                                  interpreted(grid), context(k), *team);
                if (!value.each.is_uniform) {
                    changing.values =
                        state.side_values.emplace_back(PlaneLayout(grid), precision()).address();
                    rule.values = changing.values;
                }
                changing_sides.push_back(std::move(changing));
                continue;
            }
            Field values = std::move(evaluate(value.each, k)[0]);
            rule.value = values.number_at(0, 0);
            if (is_same_everywhere(values)) continue;
            fill_halo(values, boundary_of(rules));
            rule.values = state.side_values.emplace_back(std::move(values)).address();
        }
        found.push_back(rules);
    }
    state.sides = std::move(found);
    state.changing_sides = std::move(changing_sides);
    return {};
}

Failure Simulation::Implementation::explain(const StageOutcome& outcome, std::uint32_t k) {
    NotFiniteReport report;
    report.stage = stage(k).name;
    const System& system = program->system_of(k);
    report.system = system.name;
    report.species = species_name(system, outcome.not_finite->species);
    report.found = *outcome.not_finite;
    report.speed = speed_number(k);
    report.starting = outcome.last_checked.empty();
    if (const Solver solver = stage(k).time.solver; is_semi_implicit(solver)) {
        report.semi_implicit = name_of(solver);
    }
    if (report.starting || !report.semi_implicit.empty()) return describe(report);
    report.estimate_before = stability(k, outcome.last_checked);
    report.largest_before = largest_magnitude(states[k].species);
    // A state on its way to infinity says little about the speed that would have been right: the
    // start of the stage is asked as well.
    std::vector<Field> last_finite = std::move(states[k].species);
    states[k].species.clear();
    states[k].species.resize(last_finite.size());
    start_varying_items(k);
    report.estimate_at_start = stability(k, states[k].species);
    states[k].species = std::move(last_finite);
    return describe(report);
}

void Simulation::Implementation::warn_of_chequerboard(std::uint32_t k,
                                                      RunControl& control) const {
    if (!control.warn || states[k].steps == 0) return;
    const System& system = program->system_of(k);
    for (std::size_t s = 0; s < states[k].species.size(); ++s) {
        const Mask* counted = mask ? &mask->inside : nullptr;
        if (chequerboard(states[k].species[s], counted) < chequerboard_threshold) continue;
        // The limit of explicit steps is none of a solver that takes diffusion implicitly.
        const StabilityEstimate limit = is_semi_implicit(stage(k).time.solver)
                                            ? StabilityEstimate{}
                                            : stability(k, states[k].species);
        control.warn(describe_chequerboard(stage(k).name, species_name(system, s), limit,
                                           speed_number(k)));
        return;
    }
}

}  // namespace cascade
