// Binds constraints together with the passes that read their solutions. Each constraint has its own
// binders.
#include "run/stage/plan_binder.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "run/domain/tensor_links.h"
#include "run/stage/bind_convolution.h"

#include <algorithm>
#include <array>

namespace cascade {

namespace {

/// Returns the areas of cells if they differ, as on a surface, or if some cells do not count.
/// Otherwise returns null.
std::shared_ptr<const Field> areas_of_cells(const BindingContext& context) {
    const Field* given = nullptr;
    if (!context.metric.empty()) given = &plane_of(MetricPlane::area, context);
    if (context.grid.linked) given = &plane_of(ModelPlane::area, context);
    if (given == nullptr && context.mask == nullptr) return nullptr;
    const PlaneLayout layout(context.grid);
    auto areas = std::make_shared<Field>(layout, context.precision);
    areas->visit([&]<typename Number>(Plane<Number>& plane) {
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                const bool is_inside =
                    context.mask == nullptr || context.mask->inside.row(row)[i] != 0;
                const Number area = given != nullptr ? given->row<Number>(row)[i] : Number{1};
                plane.row(row)[i] = is_inside ? area : Number{0};
            }
        }
    });
    return areas;
}

}  // namespace

const Links* links_of(const BindingContext& context, std::span<const StepPlan* const> plans) {
    if (context.tissue) return context.tissue->links;
    if (!context.grid.linked) return nullptr;
    bool has_gradients = false, has_tensors = false;
    for (const StepPlan* const plan : plans) {
        for (const Pass& pass : plan->passes) {
            for (const Instruction& each : pass.bound.kernel->code) {
                has_tensors = has_tensors || each.op == Op::link_weighted;
                has_gradients = has_gradients || each.op == Op::gradient_x ||
                                each.op == Op::gradient_y || each.op == Op::gradient_z;
            }
        }
    }
    const ModelCells& model = *context.model;
    if (!has_tensors) return has_gradients ? &model.links_with_gradients() : &model.spread().links;
    const TensorLinks& tensors = model.tensor_links();
    return has_gradients ? &tensors.links_with_gradients() : &tensors.links();
}

std::int64_t cells_inside(const BindingContext& context) {
    if (context.tissue) return context.tissue->count;
    if (context.grid.linked) return static_cast<std::int64_t>(context.model->count());
    return context.mask ? context.mask->cells : 0;
}

void take_sides(StepProblem& problem, const BindingContext& context, const System& system,
                std::uint32_t stage) {
    const StageState& state = context.states[stage];
    if (const auto* const fields = std::get_if<FieldState>(&state.values)) {
        problem.sides = fields->sides;
        problem.changing_sides = fields->changing_sides;
    }
    problem.sides_moment = {context.steps, context.t};
    // The number of species comes from the system. The state may have no planes, because they may
    // be lent to the steps.
    problem.species_needs_halo.assign(system.species_count(), false);
}

PlanBinder::PlanBinder(const StepPlan& plan, const BindingContext& context, const System* system,
                       std::uint32_t stage, const SweepForm* form, const Sweep* sweep,
                       std::vector<double> read_at)
    : plan_(plan),
      context_(context),
      system_(system),
      stage_(stage),
      form_(form),
      sweep_(sweep),
      read_at_(std::move(read_at)) {
    if (system_ != nullptr) {
        take_sides(problem_, context_, *system_, stage_);
    }
    temporary_needs_halo_.assign(plan_.temporaries, false);
    for (const Pass& pass : plan_.passes) {
        for (const Solve& solve : pass.solves) add_constraint(solve);
    }
    senses_ = context_.tissue && reads_what_is_sensed();
    for (const Pass& pass : plan_.passes) find_halos(pass);
}

StepProblem PlanBinder::bind(const Compile& compile) {
    problem_.grid = context_.grid;
    problem_.cells_inside = cells_inside(context_);
    problem_.precision = context_.precision;
    problem_.links = links_of(context_, std::array{&plan_});
    problem_.temporaries = plan_.temporaries;
    problem_.aggregates = plan_.aggregates;
    if (keeps_results_) problem_.temporaries += plan_.result_count;
    if (senses_) problem_.passes.push_back(sense());
    for (const Pass& pass : plan_.passes) {
        problem_.passes.push_back(bind_pass(pass));
        for (const Solve& solve : pass.solves) {
            problem_.passes.back().solves.push_back(bind_constraint(solve, compile));
        }
        problem_.passes.back().source = pass.bound.kernel;
        if (compile) problem_.passes.back().kernel = compile(*pass.bound.kernel);
    }
    return std::move(problem_);
}

/// Returns the temporary that contains the values that cells sense. Returns an empty optional if
/// the source is not sensed.
std::optional<TemporaryId> PlanBinder::sensed(const PlaneSource& source) const {
    if (!context_.tissue) return std::nullopt;
    const auto& all = context_.tissue->sensed;
    const auto found = std::find(all.begin(), all.end(), source);
    if (found == all.end()) return std::nullopt;
    return TemporaryId(plan_.temporaries + static_cast<std::uint32_t>(found - all.begin()));
}

bool PlanBinder::reads_what_is_sensed() const {
    return std::any_of(plan_.passes.begin(), plan_.passes.end(), [this](const Pass& pass) {
        return std::any_of(pass.bound.fields.begin(), pass.bound.fields.end(),
                           [this](const PlaneSource& source) {
                               return sensed(source).has_value();
                           });
    });
}

void PlanBinder::add_constraint(const Solve& solve) {
    const PlaneLayout layout(context_.grid);
    auto made = std::make_unique<OfConstraint>(
        OfConstraint{context_,
                     std::make_shared<Field>(layout, context_.precision),
                     std::make_shared<StepInvariants>(),
                     {}});
    made->context.unknown = made->unknown.get();
    if (solve.parts) {
        for (const PassTarget& target : solve.parts->passes.back().targets) {
            if (!std::holds_alternative<ResultId>(target.id)) continue;
            made->constant->push_back({Field(layout, context_.precision), 0, target.boundary});
        }
    }
    made->context.step_invariants = made->constant.get();
    for (const auto& plan : {solve.whole, solve.linear, solve.parts}) {
        if (!plan) continue;
        PlanBinder& binder =
            made->binders.emplace_back(*plan, made->context, system_, stage_, nullptr, sweep_);
        binder.keep_results();
        for (std::size_t k = 0; k < problem_.species_needs_halo.size(); ++k) {
            if (binder.species_needs_halo()[k]) problem_.species_needs_halo[k] = true;
        }
    }
    constraints_.emplace(&solve, std::move(made));
}

StepProblem::Solve PlanBinder::bind_constraint(const Solve& solve, const Compile& compile) {
    OfConstraint& own = *constraints_.at(&solve);
    StepProblem::Solve bound;
    bound.target = solve.target;
    bound.needs_halo = temporary_needs_halo_[solve.target];
    bound.sides = solve.boundary;
    const StageState& state = context_.states[solve.stage];
    if (solve.wall && !state.sides().empty()) {
        bound.rules = SpeciesId(state.species().size() + *solve.wall);
        bound.sides = state.sides()[bound.rules->index()];
    }
    if (system_ == nullptr) bound.rules = {};  // Rules that change exist only if there is a system.
    bound.in_register = sweep_ != nullptr ? sweep_->inputs[0] : old_register;
    bound.read_at = sweep_ != nullptr ? sweep_->time : 0;
    std::vector<std::shared_ptr<const StepProblem>> problems;
    for (PlanBinder& binder : own.binders) {
        binder.species_needs_halo() = problem_.species_needs_halo;
        binder.set_halo_registers(halo_registers_);
        problems.push_back(std::make_shared<const StepProblem>(binder.bind(compile)));
    }
    bound.whole = problems[0];
    bound.linear = problems[1];
    if (solve.parts) bound.parts = problems[2];
    bound.unknown = own.unknown;
    for (StepInvariant& part : *own.constant) {
        bound.constant.push_back(
            {std::shared_ptr<Field>(own.constant, &part.plane), part.boundary});
    }
    bound.areas = areas_of_cells(context_);
    std::shared_ptr<SolveReport>& report = (*state.fields().constraints)[solve.constraint];
    if (!report) report = std::make_shared<SolveReport>();
    bound.report = report;
    return bound;
}

/// Returns the pass that computes the values that cells sense. It comes before all other passes,
/// because positions change with every evaluation of the rates.
StepProblem::Pass PlanBinder::sense() {
    const TissueBinding& tissue = *context_.tissue;
    StepProblem::Pass pass;
    pass.kernel = tissue.sense;
    for (const StageItem item : tissue.place) pass.fields.push_back(bind_plane(item));
    for (const PlaneSource& source : tissue.sensed) {
        StepProblem::Result result;
        result.plane = *sensed(source);
        pass.results.push_back(result);
    }
    problem_.temporaries += static_cast<std::uint32_t>(tissue.sensed.size());
    return pass;
}

PlanBinder::PlaneRef PlanBinder::bind_plane(const PlaneSource& source) const {
    if (const auto temporary = sensed(source)) return *temporary;
    if (context_.tissue && source == PlaneSource(ModelPlane::number)) {
        return context_.tissue->numbers;
    }
    if (context_.tissue && source == PlaneSource(ModelPlane::area)) {
        return context_.tissue->ones;
    }
    const auto& species_of = context_.states[stage_].species_of_item;
    if (const auto* const temporary = std::get_if<TemporaryId>(&source)) return *temporary;
    if (const auto* const input = std::get_if<SweepInput>(&source)) {
        return SpeciesPlane{*species_of[input->item], sweep_->inputs[input->input]};
    }
    if (const auto* const own = std::get_if<StageItem>(&source);
        own != nullptr && is_species(*own)) {
        const SpeciesId species = *species_of[own->item];
        return SpeciesPlane{species, register_of(species)};
    }
    return &plane_of(source, context_);
}

/// Returns the rules at the sides of a plane that does not change and is read at neighbours.
SideRules PlanBinder::sides_of(const PlaneSource& source) const {
    if (const auto* const id = std::get_if<StepInvariantId>(&source)) {
        return (*context_.step_invariants)[*id].boundary;
    }
    if (const auto* const each = std::get_if<StageItem>(&source)) {
        const StageState& state = context_.states[each->stage];
        const auto species = state.species_of_item[each->item];
        if (species && !state.sides().empty()) return state.sides()[species->index()];
    }
    return context_.grid.boundary;
}

void PlanBinder::find_halos(const Pass& pass) {
    for (const FieldSlot slot : pass.bound.fields.ids()) {
        if (context_.grid.linked) continue;  // Linked cells need no halo.
        if (!pass.bound.kernel->reads_neighbours(slot)) continue;
        const Overloaded note{
            [&](SpeciesPlane own) { problem_.species_needs_halo[own.species.index()] = true; },
            [&](TemporaryId id) { temporary_needs_halo_[id] = true; },
            [&](const Field* field) {
                if (!field->empty()) field->fill_halo(sides_of(pass.bound.fields[slot]));
            },
        };
        std::visit(note, bind_plane(pass.bound.fields[slot]));
    }
}

StepProblem::Pass PlanBinder::bind_pass(const Pass& pass) const {
    StepProblem::Pass bound;
    for (const Convolution& convolution : pass.convolutions) {
        bound.convolutions.push_back(
            {bind_plane(convolution.operand), convolution.target,
             temporary_needs_halo_[convolution.target], convolution.boundary,
             std::make_shared<const WeightedLags>(weights_of(convolution, context_))});
    }
    for (const Reduction& reduction : pass.reductions) {
        bound.reductions.push_back(
            {reduction.kind, bind_plane(reduction.operand), reduction.aggregate});
    }
    for (const PlaneSource& source : pass.bound.fields) {
        bound.fields.push_back(bind_plane(source));
    }
    if (context_.tissue) {
        bound.read_by_links.assign(bound.fields.size(), false);
        for (const Instruction& each : pass.bound.kernel->code) {
            CHECK(!is_link_sum(each.op), "links between cells that crawl have no weights");
            if (each.op == Op::theirs) bound.read_by_links[each.field().index()] = true;
        }
    }
    for (const StageItem mask : pass.bound.masks) {
        bound.masks.push_back(&context_.states[mask.stage].frozen());
    }
    for (const UniformSource& source : pass.bound.uniforms) bind_uniform(source, bound);
    for (const PassTarget& target : pass.targets) bound.results.push_back(bind_result(target));
    check_overwritten(*pass.bound.kernel, bound);
    return bound;
}

/// Checks that kernels overwrite planes only in the ways that KernelArgumentsOf permits.
void PlanBinder::check_overwritten(const CellKernel& kernel, const StepProblem::Pass& bound) {
    std::map<PlaneRef, std::size_t> written;
    for (std::size_t k = 0; k < bound.results.size(); ++k) written[bound.results[k].plane] = k;
    std::optional<IdVector<FieldSlot, std::optional<std::size_t>>> sole;
    for (const FieldSlot slot : ids_below<FieldSlot>(bound.fields.size())) {
        const auto result = written.find(bound.fields[slot.index()]);
        if (result == written.end()) continue;
        if (!sole) sole = sole_results(kernel);
        CHECK((*sole)[slot] == result->second, "a result overwrites what it alone reads");
    }
}

void PlanBinder::bind_uniform(const UniformSource& source, StepProblem::Pass& bound) const {
    const UniformSlot slot(bound.uniforms.size());
    double& value = bound.uniforms.emplace_back(0);
    const auto change = [&](auto to) { bound.changing.push_back({slot, to}); };
    const Overloaded bind{
        [&](StageItem each) { value = context_.states[each.stage].numbers[each.item]; },
        [&](StepInvariantId id) { value = (*context_.step_invariants)[id].number; },
        [&](AggregateId id) { change(id); },
        [&](CoefficientId id) { change(sweep_->coefficients[id.index()]); },
        [&](TimeValue which) {
            switch (which) {
                case TimeValue::step: return change(StepProblem::CompleteSteps{});
                case TimeValue::draw: return change(StepProblem::StepDraw{});
                case TimeValue::time:
                    return change(StepProblem::MomentAt{sweep_ ? sweep_->time : 0});
                case TimeValue::length:
                    value = context_.states[stage_].time.clock.step;
                    return change(Sweep::Coefficient{1, true});
            }
        },
    };
    std::visit(bind, source);
}

StepProblem::Result PlanBinder::bind_result(const PassTarget& target) const {
    StepProblem::Result result;
    if (const auto* const temporary = std::get_if<TemporaryId>(&target.id)) {
        result.plane = *temporary;
        result.needs_halo = temporary_needs_halo_[*temporary];
        result.boundary = target.boundary;
        if (!target.wall) return result;
        // A later pass of the same evaluation of the rates reads this value at neighbours.
        const std::size_t species = context_.states[stage_].species().size();
        result.rules = SpeciesId(species + *target.wall);
        result.read_at = sweep_ != nullptr ? sweep_->time : 0;
        return result;
    }
    const std::uint32_t number = std::get<ResultId>(target.id).index();
    if (keeps_results_) {
        result.plane = TemporaryId(plan_.temporaries + number);
        return result;
    }
    SpeciesPlane own{SpeciesId(number), new_register};
    if (form_ != nullptr) {
        // Results are in the order of the outputs. Each output has one result for every species
        // that is written.
        const std::size_t written =
            form_->species.empty() ? problem_.species_needs_halo.size() : form_->species.size();
        own.in_register = sweep_->outputs[number / written];
        result.read_at = read_at_[number / written];
        const std::size_t position = number % written;
        own.species = form_->species.empty() ? SpeciesId(position) : form_->species[position];
    }
    result.plane = own;
    result.needs_halo = system_ != nullptr && !context_.grid.linked &&
                        problem_.species_needs_halo[own.species.index()] &&
                        (form_ == nullptr || halo_registers_[own.in_register]);
    return result;
}

}  // namespace cascade
