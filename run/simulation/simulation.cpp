// Starts stages, and advances the stage that runs.
#include "run/simulation/simulation.h"

#include "lang/program/stage_kinds.h"
#include "run/domain/field_values.h"
#include "run/simulation/environment.h"
#include "run/simulation/finer_run.h"
#include "run/simulation/running_stage.h"
#include "run/simulation/stage_start.h"
#include "run/simulation/stages_on_grids.h"
#include "run/stage/memory.h"
#include "run/stage/stage_time.h"

#include <cmath>
#include <map>
#include <utility>

namespace cascade {

Result<std::shared_ptr<TieredBackend>> make_stepper(const SimulationOptions& options) {
    auto backend = backend_named(options.backend).make({options.lanes, options.kernel_cache});
    if (!backend) return tl::unexpected(backend.error());
    return std::make_shared<TieredBackend>(std::move(*backend));
}

struct Simulation::Implementation {
    std::unique_ptr<StagesOnGrids> stages;
    Keeping keeping;
    /// Whether the stepper has been told which kernels later stages need.
    bool has_expected = false;
    /// The run of the stage that advanced last. Null if it cannot continue.
    std::unique_ptr<RunningStage> run;
    /// The kernels of ended stages, by stage, if compiling some of them may still fail.
    std::map<std::uint32_t, StepKernels> unsettled;

    /// Returns everything that all stages share. A stage on a coarser grid has its own environment.
    Environment& environment() const { return stages->domain(); }

    /// Must be called before states are changed.
    void end_run() {
        if (run) unsettled.insert_or_assign(run->stage(), std::move(run->kernels()));
        run.reset();
    }

    /// Warns of kernels of ended stages that could not be compiled.
    void warn_of_refused(RunControl& control) {
        for (auto& [k, kernels] : unsettled) kernels.warn_of_refused(control);
        std::erase_if(unsettled,
                      [](const auto& of_stage) { return !of_stage.second.is_provisional(); });
    }

    /// Lets the stepper compile kernels in advance for all stages after `k` whose steps take long.
    void expect_stages_after(std::uint32_t k) {
        const KernelMaker& kernels = environment().kernels;
        if (!kernels.starts_interpreted() || std::exchange(has_expected, true)) return;
        const TimeAccount::Scope spent(environment().account, Spent::compiling);
        for (std::uint32_t later = k + 1; later < environment().script.stage_count(); ++later) {
            if (is_of_cells(*environment().program, later) || stages->has_own_cells(later) ||
                !environment().takes_long(later))
                continue;
            const Stage& stage = environment().stage(later);
            const auto species = environment().program->system_of(later).species_count();
            const Scheme scheme = make_scheme(stage.time.solver, species, steps_by_item(stage));
            for (const SweepForm& form : scheme.forms) {
                for (const Pass& pass : environment().plans.sweep(later, form).passes) {
                    kernels.expect(*pass.bound.kernel);
                }
            }
        }
    }
};

Simulation::Simulation() : self_(std::make_unique<Implementation>()) {}
Simulation::~Simulation() = default;

Result<std::unique_ptr<Simulation>> Simulation::create(Script& script,
                                                       const SimulationOptions& options) {
    auto environment = make_environment(script, options);
    if (!environment) return tl::unexpected(environment.error());
    std::unique_ptr<Simulation> simulation(new Simulation);
    auto& stages = simulation->self_->stages;
    stages = std::make_unique<StagesOnGrids>(std::move(*environment), script.stage_count());
    const Environment& here = stages->domain();
    if (auto fits = check_memory(here.grid, here.memory, options.memory_limit); !fits)
        return tl::unexpected(fits.error());
    return simulation;
}

Result<void> Simulation::start_stage(std::uint32_t k, const std::atomic<bool>& cancel) {
    self_->end_run();
    self_->stages->look_back(k);
    self_->stages->touch(k);
    return cascade::start_stage(self_->stages->environment(k), self_->stages->states(k), k, cancel);
}

Result<StageEnd> Simulation::advance_stage(std::uint32_t k, std::int64_t last_step,
                                           RunControl& control,
                                           const std::function<void()>& observe, std::int64_t every,
                                           const NextMoment& next_moment) {
    Implementation& self = *self_;
    TimeAccount& account = self.environment().account;
    const TimeAccount::Scope spent(account, Spent::stepping, k);
    if (self.run && self.run->stage() != k) self.end_run();
    if (!self.run) {
        self.expect_stages_after(k);
        if (!self.stages->has_own_cells(k)) self.stages->in_domain();
        self.run = run_of(self.stages->environment(k), self.stages->states(k), k, self.keeping);
    }
    std::function<void()> seen = observe;
    if (seen && self.stages->has_own_cells(k)) {
        seen = [&] {
            self.stages->touch(k);
            observe();
        };
    }
    auto end = self.run->advance(last_step, control, {seen, every, next_moment});
    self.stages->touch(k);
    if (!self.run->can_go_on()) self.end_run();
    self.warn_of_refused(control);
    account.kernels = self.environment().kernels.stepper()->counts();
    return end;
}

void Simulation::keep_with(std::function<bool()> is_due, std::function<void()> keep) {
    self_->end_run();
    self_->keeping = {std::move(is_due), [self = self_.get(), keep = std::move(keep)] {
                          if (self->run) self->stages->touch(self->run->stage());
                          keep();
                      }};
}

void Simulation::settle(RunControl& control) {
    self_->end_run();
    if (self_->unsettled.empty()) return;
    const TimeAccount::Scope spent(self_->environment().account, Spent::compiling);
    self_->environment().kernels.stepper()->settle();
    self_->warn_of_refused(control);
}

void Simulation::change_stage(std::uint32_t stage, const std::function<void(StageState&)>& change) {
    self_->end_run();
    change(self_->stages->state(stage));
    self_->stages->touch(stage);
}

Result<void> Simulation::go_on_from(const Simulation& coarse, std::uint32_t stage) {
    StagesOnGrids& stages = *self_->stages;
    stages.take_divided(*coarse.self_->stages);
    stages.look_back(stage);
    stages.environment(stage).progress_note = ", on finer cells";
    return settle_in_finer_cells(stages.environment(stage), stages.states(stage), stage);
}

std::vector<Field> Simulation::evaluate(const Formula& formula, std::uint32_t stage) const {
    return self_->stages->view(stage).evaluate(formula);
}

std::vector<Field> Simulation::evaluate(std::span<const Formula* const> formulas,
                                        std::uint32_t stage) const {
    return self_->stages->view(stage).evaluate(formulas);
}

const SimulationDomain& Simulation::domain() const { return self_->environment(); }
const SimulationDomain& Simulation::domain(std::uint32_t stage) const {
    return self_->stages->environment(stage);
}
StageView Simulation::view(std::uint32_t stage) const { return self_->stages->view(stage); }
StageView Simulation::own_view(std::uint32_t stage) const { return self_->stages->own_view(stage); }
const StageState& Simulation::state(std::uint32_t stage) const {
    return self_->stages->state(stage);
}
const Field& Simulation::field(std::uint32_t stage, ItemId item) const {
    return self_->stages->in_domain()[stage].field(item);
}

std::vector<double> evaluate_numbers(const Simulation& simulation,
                                     std::span<const Formula* const> formulas,
                                     std::uint32_t stage) {
    return first_values(simulation.evaluate(formulas, stage));
}

double time_of(const Simulation& simulation, std::uint32_t stage) {
    const Program& program = *simulation.domain().program;
    const bool is_timed = program.stages[stage].uniform[program.system_of(stage).speed_item()];
    return is_timed ? simulation.state(stage).t : NAN;
}

std::uint32_t shown_stage(const Simulation& simulation) {
    std::uint32_t shown = 0;
    for (std::uint32_t k = 0; k < simulation.domain().program->stages.size(); ++k) {
        if (simulation.state(k).started && simulation.state(k).steps > 0) shown = k;
    }
    return shown;
}

}  // namespace cascade
