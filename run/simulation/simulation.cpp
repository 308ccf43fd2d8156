// Starts stages and advances the one that runs.
#include "run/simulation/simulation.h"

#include "lang/program/nodes_of_rates.h"
#include "run/domain/field_values.h"
#include "run/simulation/environment.h"
#include "run/simulation/finer_run.h"
#include "run/simulation/finer_view.h"
#include "run/simulation/pinned_fronts.h"
#include "run/simulation/stage_doubts.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/stage_start.h"
#include "run/simulation/stage_tools.h"
#include "run/simulation/stages_on_grids.h"
#include "run/simulation/tissue_run.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/memory.h"
#include "run/stage/stage_remarks.h"
#include "run/tissue/ground.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <algorithm>
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
    bool has_expected = false;  ///< Has the stepper been told what later stages need?
    std::unique_ptr<RunningStage>
        run;  ///< The run of the stage that advanced last, if it can go on.
    /// By stage: kernels of stages that ended before it was known whether all can be compiled.
    std::map<std::uint32_t, StepKernels> unsettled;

    /// What all stages share, but for coarser grids.
    Environment& environment() const { return stages->domain(); }

    std::unique_ptr<RunningStage> make_run(std::uint32_t k) {
        if (environment().program->system_of(k).cells) {
            return std::make_unique<TissueRun>(environment(), stages->in_domain(), k, keeping);
        }
        return std::make_unique<StageRun>(stages->environment(k), stages->states(k), k, keeping);
    }

    /// Must be called before states are changed.
    void end_run() {
        if (run) unsettled.insert_or_assign(run->stage(), std::move(run->kernels()));
        run.reset();
    }

    /// Gives an item other values, in the stage's own cells.
    void set(std::uint32_t stage, ItemId item, Field values) {
        StageState& state = stages->state(stage);
        const System& system = environment().program->system_of(stage);
        const auto species = state.species_of_item[item];
        if (Tissue* const tissue = state.tissue.get()) {
            (species ? tissue->species[species->index()] : tissue->kept[item.index()]) =
                std::move(values);
            tissue->pad();
            if (item == system.frozen_item()) tissue->freeze_by(item.index());
            return;
        }
        CHECK(species || !environment().stage(stage).uniform[item],
              "only an item that varies has a field");
        if (item == system.frozen_item()) state.frozen = to_mask(values);
        (species ? state.species[species->index()] : state.fields[item]) = std::move(values);
    }

    /// Warns of kernels of ended stages that could not be compiled.
    void warn_of_refused(RunControl& control) {
        for (auto& [k, kernels] : unsettled) kernels.warn_of_refused(control);
        std::erase_if(unsettled,
                      [](const auto& of_stage) { return !of_stage.second.is_provisional(); });
    }

    /// Lets the stepper compile the kernels of stages after `k`, if their steps take long.
    void expect_stages_after(std::uint32_t k) {
        const KernelMaker& kernels = *environment().kernels;
        if (!kernels.starts_interpreted() || std::exchange(has_expected, true)) return;
        const TimeAccount::Scope spent(environment().account, Spent::compiling);
        for (std::uint32_t later = k + 1; later < environment().script->stage_count(); ++later) {
            const bool is_of_fields = !environment().program->system_of(later).cells;
            if (!is_of_fields || stages->has_own_cells(later) || !environment().takes_long(later))
                continue;
            const Stage& stage = environment().stage(later);
            const auto species = environment().program->system_of(later).species_count();
            const Scheme scheme = make_scheme(stage.time.solver, species, steps_by_item(stage));
            for (const SweepForm& form : scheme.forms) {
                for (const Pass& pass : environment().plans->sweep(later, form).passes) {
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
    if (!program().system_of(k).cells) {
        return cascade::start_stage(self_->stages->environment(k), self_->stages->states(k), k);
    }
    return start_tissue(self_->environment(), self_->stages->in_domain(), k, cancel);
}

Result<StageEnd> Simulation::advance_stage(std::uint32_t k, std::int64_t last_step,
                                           RunControl& control,
                                           const std::function<void()>& observe,
                                           std::int64_t every) {
    Implementation& self = *self_;
    TimeAccount* account = self.environment().account;
    const TimeAccount::Scope spent(account, Spent::stepping, k);
    if (self.run && self.run->stage() != k) self.end_run();
    if (!self.run) {
        self.expect_stages_after(k);
        self.run = self.make_run(k);
    }
    std::function<void()> seen = observe;
    if (seen && self.stages->has_own_cells(k)) {
        seen = [&] {
            self.stages->touch(k);
            observe();
        };
    }
    auto end = self.run->advance(last_step, control, seen, every);
    self.stages->touch(k);
    if (!self.run->can_go_on()) self.end_run();
    self.warn_of_refused(control);
    if (account != nullptr) account->kernels = self.environment().kernels->stepper()->counts();
    return end;
}

std::string Simulation::remark_on(std::uint32_t k) const {
    const StageView view = self_->stages->own_view(k);
    if (view.state().tissue) return remark_on_cells(view);
    const Environment& here = view.environment();
    const std::string remark = describe_end(view.stage(), view.system(), view.state(),
                                            k == here.script->final_stage(), here.counted());
    if (!remark.empty()) return remark;
    if (!has_stood_still(view)) return find_pinned_fronts(view).value_or("");
    return fmt::format(
        "stage '{}' ended as it began: its rates are 0 in all cells{}", view.stage().name,
        here.grid.height == 1 && !here.model ? "; on a line derivatives along y are 0" : "");
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
    self_->environment().kernels->stepper()->settle();
    self_->warn_of_refused(control);
}

void Simulation::restore(std::uint32_t stage, StageRecord record) {
    self_->end_run();
    self_->stages->touch(stage);
    StageState& state = self_->stages->state(stage);
    const System& system = program().system_of(stage);
    static_cast<StageMoment&>(state) = std::move(record);
    if (record.cells) {
        state.tissue = std::make_shared<Tissue>(*record.cells, program().domain.precision);
        return state.go_to(state.steps, record.cells->time.t);
    }
    state.course = {};
    for (const ItemId item : system.items()) {
        const auto found = record.fields.find(system.item_name(item));
        CHECK(found != record.fields.end() || !system.is_species(item),
              "every species of the stage is given");
        if (found != record.fields.end()) self_->set(stage, item, std::move(found->second));
    }
    state.go_to(state.steps, state.t);
}

std::vector<std::vector<double>> Simulation::values_of_start(std::uint32_t stage) const {
    return cascade::values_of_start(self_->environment(), self_->stages->in_domain(), stage);
}

std::size_t Simulation::remove_cells(std::uint32_t stage, const Field& chosen) {
    self_->end_run();
    Tissue& tissue = *self_->stages->state(stage).tissue;
    std::vector<std::uint32_t> left;
    for (std::uint32_t cell = 0; cell < tissue.count(); ++cell) {
        if (value_in(chosen, tissue, cell) == 0) left.push_back(cell);
    }
    if (!left.empty()) tissue.rearrange(left);
    return left.size();
}

Result<void> Simulation::go_on_from(const Simulation& coarse, std::uint32_t stage) {
    StagesOnGrids& stages = *self_->stages;
    stages.take_divided(*coarse.self_->stages);
    stages.look_back(stage);
    stages.environment(stage).progress_note = ", on finer cells";
    return settle_in_finer_cells(stages.environment(stage), stages.states(stage), stage);
}

void Simulation::end_stage(std::uint32_t stage) {
    self_->end_run();
    self_->stages->state(stage).done = true;
    self_->stages->touch(stage);
}

void Simulation::set_field(std::uint32_t stage, ItemId item, Field values) {
    self_->end_run();
    self_->stages->touch(stage);
    self_->set(stage, item, std::move(values));
}

Field Simulation::in_cells_of(std::uint32_t stage, ItemId item, Field values) const {
    return self_->stages->in_cells_of(stage, item, std::move(values));
}

std::vector<Field> Simulation::evaluate(const Formula& formula, std::uint32_t stage) const {
    return self_->stages->view(stage).evaluate(formula);
}

std::vector<Field> Simulation::evaluate(std::span<const Formula* const> formulas,
                                        std::uint32_t stage) const {
    return self_->stages->view(stage).evaluate(formulas);
}

std::unique_ptr<const FinerView> Simulation::finer(std::int64_t times) const {
    const Environment& here = self_->environment();
    const std::span<const StageState> states = self_->stages->in_domain();
    const bool has_tissue = std::any_of(states.begin(), states.end(),
                                        [](const StageState& state) { return state.tissue; });
    const DomainSettings& domain = here.program->domain;
    if (has_tissue || here.mask || here.model || domain.surface || here.grid.depth > 1) {
        return nullptr;
    }
    return std::make_unique<const FinerView>(here, states, times);
}

StepWork Simulation::step_work(std::uint32_t k) {
    self_->end_run();
    StageState& state = self_->stages->state(k);
    CHECK(state.started, "a stage is started before its steps are counted");
    const StepInvariants invariants = find_step_invariants(self_->stages->own_view(k));
    const StageView view(self_->stages->environment(k), self_->stages->states(k), k, &invariants);
    StageTimer timer(view.program(), k, state, stage_tools(view, {}));  // Nothing is run.
    return work_of(timer.problem());
}

const Program& Simulation::program() const { return *self_->environment().program; }
const std::map<std::string, double>& Simulation::known_sizes() const {
    return self_->environment().known_sizes;
}
const Grid& Simulation::grid() const { return self_->environment().grid; }
std::shared_ptr<const ModelCells> Simulation::model() const { return self_->environment().model; }
const DomainMask* Simulation::mask() const { return self_->environment().inside(); }
double Simulation::memory() const { return self_->environment().memory; }
const Program& Simulation::program(std::uint32_t stage) const {
    return *self_->stages->environment(stage).program;
}
const Grid& Simulation::grid(std::uint32_t stage) const {
    return self_->stages->environment(stage).grid;
}
const StageState& Simulation::state(std::uint32_t stage) const {
    return self_->stages->state(stage);
}
const Field& Simulation::field(std::uint32_t stage, ItemId item) const {
    return self_->stages->in_domain()[stage].field(item);
}

std::optional<std::uint32_t> Simulation::shown_stage() const {
    std::optional<std::uint32_t> shown;
    for (std::uint32_t k = 0; k < program().stages.size(); ++k) {
        if (state(k).started && !shown) shown = k;
        if (state(k).started && state(k).steps > 0) shown = k;
    }
    return shown;
}

std::shared_ptr<const SurfaceMesh> Simulation::body(std::uint32_t stage) const {
    const auto& ground = state(stage).ground;
    if (!ground || ground->body() == nullptr) return nullptr;
    return {ground, ground->body()};
}

std::vector<double> evaluate_numbers(const Simulation& simulation,
                                     std::span<const Formula* const> formulas,
                                     std::uint32_t stage) {
    return first_values(simulation.evaluate(formulas, stage));
}

double time_of(const Simulation& simulation, std::uint32_t stage) {
    const Program& program = simulation.program();
    const bool is_timed = program.stages[stage].uniform[program.system_of(stage).speed_item()];
    return is_timed ? simulation.state(stage).t : NAN;
}

bool made_its_pattern(const Simulation& simulation, std::uint32_t k) {
    // A species whose deviation has grown by this factor owes its pattern to the stage.
    constexpr double times_at_start = 3;
    const Stage& stage = simulation.program().stages[k];
    const System& system = simulation.program().system_of(k);
    if (system.cells) return false;
    const auto is_of_neighbours = [](const Node& node) {
        return node.is<Call>() && differentiates(node.function);
    };
    for (const ItemId item : system.quantities.ids()) {
        if (!system.is_species(item) && !stage.uniform[item]) return false;
    }
    if (holds_in_rates(system, is_draw) || !holds_in_rates(system, is_of_neighbours)) return false;
    const StageCourse& course = simulation.state(k).course;
    if (course.empty()) return false;
    for (std::size_t s = 0; s < course.last().species.size(); ++s) {
        const Spread &first = course.first().species[s], &last = course.last().species[s];
        const bool is_made = last.is_even(course.last().largest[s]) ||
                             last.deviation() >= times_at_start * first.deviation();
        if (!is_made) return false;
    }
    return true;
}

}  // namespace cascade
