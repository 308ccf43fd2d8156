// Creates the run, starts and advances stages, and provides the tools with which a stage chooses
// its steps. Other parts of Simulation::Implementation have files of their own beside it.
#include "run/simulation/simulation.h"

#include "ir/interpreter.h"
#include "run/domain/field_values.h"
#include "run/simulation/simulation_implementation.h"
#include "run/stage/bound_diffusion.h"
#include "run/stage/memory.h"
#include "run/stage/stage_remarks.h"
#if CASCADE_HAS_JIT
#include "jit/jit.h"
#endif

#include <algorithm>

namespace cascade {

bool has_jit() { return CASCADE_HAS_JIT; }

std::string describe_backend() {
#if CASCADE_HAS_JIT
    return "native code by " + describe_jit();
#else
    return "interpreter only, without LLVM";
#endif
}

Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options) {
    if (options.backend == BackendKind::interpreter) {
        return std::make_shared<TieredBackend>(make_interpreter());
    }
#if CASCADE_HAS_JIT
    JitOptions jit;
    jit.lanes = options.lanes;
    jit.cache = options.kernel_cache;
    auto native = make_jit(jit);
    if (!native) return tl::unexpected(native.error());
    return std::make_shared<TieredBackend>(std::move(*native));
#else
    return failure("this build has no native compiler", "use --backend interp");
#endif
}

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
    self.tiling = options.tiling;
    self.threads = options.threads > 0 ? options.threads : hardware_threads();
    self.account = options.account;
    for (std::uint32_t k = 0; self.account != nullptr && k < script.stage_count(); ++k) {
        self.account->stage(k).name = self.stage(k).name;
    }
    self.plans = std::make_unique<StagePlans>(*self.program, options.planning);
    // How many faces or points a model has is known only when it has been read.
    const auto& model = self.program->domain.model;
    if (!model || model->cells == ModelCellKind::spread) {
        if (auto fits = self.check_memory(options.memory_limit); !fits)
            return tl::unexpected(fits.error());
    }
    if (model) {
        if (auto made = self.make_cells(options); !made) return tl::unexpected(made.error());
        if (auto fits = self.check_memory(options.memory_limit); !fits)
            return tl::unexpected(fits.error());
    }
    auto files = [&] {
        const TimeAccount::Scope spent(self.account, Spent::reading);
        return read_input_files(script, self.model.get());
    }();
    if (!files) return tl::unexpected(files.error());
    self.files = std::move(*files);
    auto metric = metric_planes(*self.program);
    if (!metric) return tl::unexpected(metric.error());
    self.metric = std::move(*metric);

    self.interpreter = make_interpreter();
    self.stepper = options.stepper;
    if (!self.stepper) {
        const TimeAccount::Scope spent(self.account, Spent::compiling);
        auto stepper = make_stepper(options);
        if (!stepper) return tl::unexpected(stepper.error());
        self.stepper = std::move(*stepper);
    }
    self.tilings.emplace(options.kernel_cache, self.stepper->code_identity());
    self.starts_interpreted = options.starts_interpreted;
    self.team = std::make_unique<Team>(self.is_small() ? 1 : self.threads);
    self.states.resize(self.program->stages.size());
    if (auto made = self.make_surface_values(options); !made) return tl::unexpected(made.error());
    if (options.control != nullptr) self.warn_of_even_pictures(*options.control);
    if (auto found = self.find_mask(options.control); !found) return tl::unexpected(found.error());
    return simulation;
}

Result<void> Simulation::start_stage(std::uint32_t k) {
    Implementation& self = *self_;
    const TimeAccount::Scope spent(self.account, Spent::starting, k);
    const System& system = self.program->system_of(k);
    StageState& state = self.states[k];
    state = empty_state(system);
    self.start_uniform_items(k);
    self.start_varying_items(k);
    if (auto sides = self.find_sides(k); !sides) return sides;
    state.started = true;
    return self.check_speed(k);
}

namespace {

/// Steps between two looks: a stage of few steps is looked at as often as a long one.
std::int64_t look_every(const Stage& stage, std::int64_t usual) {
    constexpr std::int64_t looks = 10;
    return std::clamp<std::int64_t>(stage.iterations / looks, 1, usual);
}

}  // namespace

void Simulation::Implementation::look_at(std::uint32_t k) {
    StageState& state = states[k];
    // Steps of different length in different cells are counted, not timed.
    const bool is_timed = stage(k).uniform[program->system_of(k).speed_item()];
    const double age = is_timed ? state.t : static_cast<double>(state.steps);
    state.course.look(state.steps, age, state.species, counted());
}

Result<StageEnd> Simulation::advance_stage(std::uint32_t k, std::int64_t last_step,
                                           RunControl& control,
                                           const std::function<void()>& observe,
                                           std::int64_t every) {
    Implementation& self = *self_;
    StageState& state = self.states[k];
    const Stage& stage = self.stage(k);
    CHECK(state.started, "a stage is started before it advances");
    const TimeAccount::Scope spent(self.account, Spent::stepping, k);
    const std::int64_t steps_before = state.steps;
    if (state.course.empty()) self.look_at(k);

    StepKernels kernels(stage.name);
    StageTimer timer(*self.program, k, state, self.tools(k, self.compiled(k, kernels, control)));
    if (timer.substeps() > 1 && state.steps == 0 && control.warn) {
        control.warn(
            fmt::format("stage '{}': each step is split into {}, so that it is stable in the "
                        "smallest cells of the model",
                        stage.name, timer.substeps()));
    }
    // Nothing moves where everything is frozen: its steps are complete as they begin.
    if (self.frozen_everywhere(k)) {
        state.steps = stage.time.has_duration() ? 0 : last_step;
        state.done = stage.time.has_duration() || state.steps >= stage.iterations;
        return state.done ? StageEnd::finished : StageEnd::stopped;
    }
    self.expect_later_stages(k);
    if (state.steps == 0 && last_step > 0 && stage.time.coarse > 1) {
        auto grown = self.run_on_coarser_grids(k, control);
        if (!grown || *grown == StageEnd::cancelled) return grown;
    }
    self.undefined_is_told = false;
    if (state.steps == 0) self.warn_of_undefined_start(k, control);
    self.listener = &control;
    self.until_is_told = false;
    self.until_watch.reset();
    self.find_step_invariants(k);
    Progress progress;
    progress.stage = stage.name;
    progress.note = self.progress_note;
    progress.stage_number = static_cast<int>(k) + 1;
    progress.stage_count = static_cast<int>(self.script->stage_count());
    progress.steps = stage.iterations;
    progress.when_met = stage.time.steady ? "settled" : "'until' came true";
    Schedule schedule = timer.schedule(last_step, every > 0 ? every : stage.interval);
    schedule.tenths = stage.interval == 0;
    schedule.check_every = look_every(stage, schedule.check_every);
    schedule.onlooker = [&](std::int64_t step, double t, std::span<const Field>) {
        if (!state.course.is_due(step)) return;
        state.steps = step;
        state.t = t;
        self.look_at(k);
    };
    schedule.threads = self.threads;
    schedule.tiling = self.tiling;
    std::optional<StageTilings> tilings;
    if (self.tilings) {
        schedule.tilings = &tilings.emplace(*self.tilings, timer.problem(), kernels.identity());
    }
    schedule.keep_is_due = self.keep_is_due;
    schedule.keep = [&](std::int64_t step, double t, const TimeState& time) {
        state.steps = step;
        state.t = t;
        state.time = time;
        self.keep();
    };
    TimeLoop loop(timer.problem(), schedule, state.species, progress);
    const StageOutcome outcome =
        loop.advance(last_step, schedule.interval, control,
                     [&](std::int64_t step, double t, std::span<const Field>) {
                         state.steps = step;
                         state.t = t;
                         if (observe) observe();
                         return true;
                     });
    self.listener = nullptr;
    self.unsettled.insert_or_assign(k, std::move(kernels));
    self.warn_of_refused(control);
    if (outcome.cancelled) self.stepper->abandon();
    state.steps = outcome.steps;
    state.t = outcome.t;
    state.time = outcome.time;
    if (!outcome.not_finite && !outcome.too_short && !outcome.cancelled) {
        self.warn_of_doubts(k, timer, control);
        self.warn_of_undefined_end(k, control);
    }
    state.step_invariants.clear();
    self.account_for(k, state.steps - steps_before, outcome, loop);
    if (outcome.not_finite) return tl::unexpected(self.explain(outcome, k));
    if (outcome.too_short) return tl::unexpected(self.explain(*outcome.too_short, k));
    if (outcome.cancelled) return StageEnd::cancelled;
    state.done = outcome.ended || state.steps >= stage.iterations;
    // What is in doubt has no course, and no more is said of it.
    if (state.done && !state.course.empty()) self.look_at(k);
    return state.done ? StageEnd::finished : StageEnd::stopped;
}

std::string Simulation::remark_on(std::uint32_t k) const {
    const std::string remark =
        describe_end(self_->stage(k), self_->program->system_of(k), self_->states[k],
                     k == self_->script->final_stage(), self_->counted());
    if (!remark.empty() || !self_->has_stood_still(k)) return remark;
    return fmt::format(
        "stage '{}' ended as it began: its rates are 0 in all cells{}", self_->stage(k).name,
        self_->grid.height == 1 && !self_->model ? "; on a line derivatives along y are 0" : "");
}

void Simulation::keep_with(std::function<bool()> is_due, std::function<void()> keep) {
    self_->keep_is_due = std::move(is_due);
    self_->keep = std::move(keep);
}

void Simulation::set_species(std::uint32_t stage, std::vector<Field> species, std::int64_t steps,
                             bool done, bool condition_met) {
    StageState& state = self_->states[stage];
    CHECK(species.size() == state.species.size(), "every species of the stage is given");
    state.species = std::move(species);
    state.course = {};
    state.steps = steps;
    state.done = done;
    state.condition_met = condition_met;
}

void Simulation::set_time(std::uint32_t stage, double t, const TimeState& time, SteadyWatch watch) {
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
std::shared_ptr<const ModelCells> Simulation::model() const { return self_->model; }
const DomainMask* Simulation::mask() const { return self_->inside(); }
double Simulation::memory() const { return self_->memory; }
const StageState& Simulation::state(std::uint32_t stage) const { return self_->states[stage]; }

double Simulation::time(std::uint32_t stage) const {
    const StageState& state = self_->states[stage];
    const bool is_timed =
        self_->program->stages[stage].uniform[self_->program->system_of(stage).speed_item()];
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

void Simulation::Implementation::account_for(std::uint32_t k, std::int64_t steps,
                                             const StageOutcome& outcome,
                                             const TimeLoop& loop) const {
    if (account == nullptr) return;
    account->kernels = stepper->counts();
    TimeAccount::Stage& entry = account->stage(k);
    entry.steps += steps;
    entry.cells = grid.cell_count();
    entry.threads = outcome.threads;
    entry.stepping = loop.stepping();
}

StageTools Simulation::Implementation::tools(std::uint32_t k, Compile steps) const {
    StageTools tools;
    tools.numbers = [this, k](std::span<const Formula* const> formulas) {
        const auto runner = std::make_shared<PlanRunner>(plan_view(*program, formulas, k), often());
        return [this, k, runner] {
            std::vector<double> numbers;
            for (const Field& field : runner->run(context(k), *team)) {
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
    tools.bind = [this, k, largest, compile = std::move(steps)](const Scheme& scheme) {
        const TimeAccount::Scope spent(account, Spent::compiling);
        std::vector<StepPlan> sweeps;
        for (const SweepForm& form : scheme.forms) sweeps.push_back(plans->sweep(k, form));
        const auto bind = [&](const StepPlan& before) {
            return bind_scheme(scheme, sweeps, before, compile, context(k), program->system_of(k),
                               k);
        };
        if (!is_semi_implicit(stage(k).time.solver)) return bind({});
        const BoundDiffusion diffusion(*program, k, largest);
        StepProblem problem = bind(diffusion.before());
        diffusion.add_to(problem);
        return problem;
    };
    tools.over_time = [this, k](const Formula& formula, double duration) {
        const Grid one{1, 1, Boundary::periodic};
        // Compiled once and not for every moment.
        std::map<const CellKernel*, KernelPointer> made;
        const Compile compile = [&made, interpret = interpreted(one)](const CellKernel& kernel) {
            KernelPointer& known = made[&kernel];
            if (!known) known = interpret(kernel);
            return known;
        };
        PlanRunner runner(plan_view(*program, formula, k), compile);
        Team alone(1);
        BindingContext context = this->context(k);
        context.grid = one;
        std::vector<double> values;
        for (std::size_t n = 0; n <= Forcing::intervals; ++n) {
            context.t = duration * static_cast<double>(n) / static_cast<double>(Forcing::intervals);
            values.push_back(runner.run(context, alone)[0].number_at(0, 0));
        }
        return values;
    };
    tools.inside = counted();
    tools.model = model.get();
    tools.is_true = [this, k](const Formula& formula) {
        look_at_until(k);
        return evaluate(plan_view(*program, formula, k), k)[0].number_at(0, 0) != 0;
    };
    tools.estimate = [this, k, compile = often()] {
        const auto limit = stability(k, states[k].species, compile).largest_speed;
        return limit ? 2 / *limit : 0;
    };
    return tools;
}

}  // namespace cascade
