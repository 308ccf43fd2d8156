// Makes the plans of sweeps.
#include "core/check.h"
#include "lang/lower/cell_equations.h"
#include "lang/lower/lower.h"
#include "lang/lower/step_graph.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace cascade {

namespace lowering {

namespace {

/// Emits the results of a sweep: applies the form to the rates and inputs of every species.
class SweepEmitter {
public:
    SweepEmitter(const Program& program, std::uint32_t stage, const SweepForm& form)
        : program_(program), stage_(stage), form_(form), system_(program.system_of(stage)) {
        const auto all = system_.species();
        if (form.species.empty()) species_ = all;
        for (const SpeciesId id : form.species) species_.push_back(all[id]);
    }

    StepPlan plan(const PlanOptions& options) {
        const StepGraph step(program_, stage_, options);
        rates_ = step.rates;
        std::vector<NodeId> wanted;
        for (const ItemId item : system_.rate_order) {
            if (!is_written(item)) continue;
            if (form_.uses_rates() || (form_.holds && is_bounded(item)))
                wanted.push_back(rates_[item]);
        }
        for (std::size_t k = 0; k < system_.invariants.size(); ++k) {
            if (!is_written(system_.invariants[k].species)) continue;
            bounds_.push_back({&system_.invariants[k], step.bounds[k]});
            wanted.push_back(step.bounds[k]);
        }
        if (form_.equations) {
            derivatives_ = step.derivatives;
            for (const auto& row : derivatives_)
                wanted.insert(wanted.end(), row.begin(), row.end());
        }
        const auto slots = system_.species();
        PlanBuilder builder(
            {step.graph, wanted, options, true, slots, step.step_invariants, program_.domain.fast});
        if (form_.equations) solve(builder);
        for (const SweepOutput& output : form_.outputs) emit(builder, output);
        StepPlan plan = std::move(builder).finish();
        for (std::size_t o = 0; o < form_.outputs.size(); ++o) {
            plan.results.insert(plan.results.end(), species_.begin(), species_.end());
        }
        return plan;
    }

private:
    bool is_bounded(ItemId item) const {
        return std::any_of(system_.invariants.begin(), system_.invariants.end(),
                           [&](const Invariant& invariant) { return invariant.species == item; });
    }

    bool is_written(ItemId item) const {
        return std::find(species_.begin(), species_.end(), item) != species_.end();
    }

    /// The value that a species has in an input, in the cell itself. Input 0 contains the items
    /// that formulas read.
    ValueId input(PlanBuilder& plan, std::uint32_t input, ItemId item) const {
        if (input == 0) return plan.last_pass().field(StageItem{stage_, item});
        return plan.last_pass().field(SweepInput{input, item});
    }

    ValueId base(PlanBuilder& plan, ItemId item) const {
        return input(plan, form_.base_input, item);
    }

    ValueId term(PlanBuilder& plan, const SweepTerm& term, SweepOutput::Kind kind,
                 ItemId item) const {
        KernelBuilder& builder = plan.last_pass().builder();
        ValueId value{};
        switch (term.source) {
            case SweepTerm::Source::value: value = input(plan, term.input, item); break;
            case SweepTerm::Source::difference:
                value = builder.subtract(input(plan, term.input, item), base(plan, item));
                break;
            case SweepTerm::Source::rate:
                value = plan.value(rates_[item])[0];
                // A rate that points beyond a bound counts as 0 if the value is at this bound.
                // Without this, the cell would affect other cells in methods that combine or filter
                // rates.
                if (kind != SweepOutput::Kind::change && !form_.ignores_held_rates) break;
                if (const auto held = is_held(plan, item)) {
                    value = builder.select(*held, builder.number(0), value);
                }
                break;
            case SweepTerm::Source::solution: value = solution_[item]; break;
        }
        switch (term.weight) {
            case SweepTerm::Weight::one: return value;
            case SweepTerm::Weight::speed:
                return builder.multiply(plan.last_pass().item(system_.speed_item()), value);
            case SweepTerm::Weight::coefficient:
                return builder.multiply(plan.last_pass().uniform(CoefficientId(term.coefficient)),
                                        value);
        }
        CHECK(false, "lowering: every weight has a meaning");
    }

    ValueId sum_of(PlanBuilder& plan, const std::vector<SweepTerm>& terms, SweepOutput::Kind kind,
                   ItemId item) const {
        std::optional<ValueId> sum;
        for (const SweepTerm& each : terms) {
            const ValueId value = term(plan, each, kind, item);
            sum = sum ? plan.last_pass().builder().add(*sum, value) : value;
        }
        CHECK(sum, "lowering: an output has terms");
        return *sum;
    }

    /// Solves the form's equations. The unknowns are all species.
    void solve(PlanBuilder& plan) {
        KernelBuilder& builder = plan.last_pass().builder();
        const SweepForm::Equations& equations = *form_.equations;
        const ValueId c = plan.last_pass().uniform(CoefficientId(equations.coefficient));
        std::vector<std::vector<ValueId>> rows;
        for (const SpeciesId of : derivatives_.ids()) {
            const ItemId item = species_[of.index()];
            const auto held = is_held(plan, item);
            std::vector<ValueId>& row = rows.emplace_back();
            for (std::size_t by = 0; by < derivatives_.size(); ++by) {
                const ValueId slope = plan.value(derivatives_[of][by])[0];
                const ValueId one = builder.number(by == of.index() ? 1 : 0);
                if (is_zero(builder, slope)) {
                    row.push_back(one);
                    continue;
                }
                const ValueId entry = builder.subtract(one, builder.multiply(c, slope));
                row.push_back(held ? builder.select(*held, one, entry) : entry);
            }
            row.push_back(sum_of(plan, equations.terms, SweepOutput::Kind::change, item));
        }
        const std::vector<ValueId> x = solve_equations(builder, std::move(rows));
        solution_.resize(system_.quantities.size());
        for (std::size_t k = 0; k < x.size(); ++k) solution_[species_[k]] = x[k];
    }

    void emit(PlanBuilder& plan, const SweepOutput& output) const {
        KernelBuilder& builder = plan.last_pass().builder();
        IdVector<ItemId, ValueId> next(system_.quantities.size());
        for (const ItemId item : species_) {
            next[item] = sum_of(plan, output.terms, output.kind, item);
        }
        if (output.kind == SweepOutput::Kind::state) {
            if (form_.holds) hold(plan, next);
            clamp(plan, next);
        }
        const bool freezes = !program_.stages[stage_].uniform[system_.frozen_item()];
        for (const ItemId item : species_) {
            if (freezes) {
                const ValueId kept =
                    output.kind == SweepOutput::Kind::state ? base(plan, item) : builder.number(0);
                next[item] =
                    builder.select(plan.last_pass().item(system_.frozen_item()), kept, next[item]);
            }
            plan.result(system_.quantities[item].name, plan.last_pass().within_mask(next[item], 0));
        }
    }

    void hold(PlanBuilder& plan, IdVector<ItemId, ValueId>& next) const {
        for (const ItemId item : species_) {
            if (const auto held = is_held(plan, item)) {
                next[item] = plan.last_pass().builder().select(*held, base(plan, item), next[item]);
            }
        }
    }

    /// Clamps the values by the bounds, in the order that the bounds have in the script.
    void clamp(PlanBuilder& plan, IdVector<ItemId, ValueId>& next) const {
        KernelBuilder& builder = plan.last_pass().builder();
        for (const auto& [invariant, part] : bounds_) {
            const ValueId bound = plan.value(part)[0];
            ValueId& value = next[invariant->species];
            value = invariant->at_least ? builder.clamp_below(value, bound)
                                        : builder.clamp_above(value, bound);
        }
    }

    /// Whether the value in input 0 is at a bound and its rate points beyond the bound. nullopt if
    /// the species has no bound.
    std::optional<ValueId> is_held(PlanBuilder& plan, ItemId item) const {
        KernelBuilder& builder = plan.last_pass().builder();
        const ValueId zero = builder.number(0);
        std::optional<ValueId> held;
        for (const auto& [invariant, part] : bounds_) {
            if (invariant->species != item) continue;
            const bool at_least = invariant->at_least;
            const ValueId bound = plan.value(part)[0];
            const ValueId value = input(plan, 0, item), rate = plan.value(rates_[item])[0];
            const auto less = [&](Op op, ValueId low, ValueId high) {
                return at_least ? builder.apply(op, low, high) : builder.apply(op, high, low);
            };
            const ValueId is_here =
                builder.apply(Op::logical_and, less(Op::less_equal, value, bound),
                              less(Op::less, rate, zero));
            held = held ? builder.apply(Op::logical_or, *held, is_here) : is_here;
        }
        return held;
    }

    const Program& program_;
    std::uint32_t stage_;
    const SweepForm& form_;
    const System& system_;
    std::vector<ItemId> species_;  ///< The species that are written.
    IdVector<ItemId, NodeId> rates_;
    /// The derivatives of the rates, if the form has `equations`.
    IdVector<SpeciesId, std::vector<NodeId>> derivatives_;
    IdVector<ItemId, ValueId> solution_;                       ///< The solution of `equations`.
    std::vector<std::pair<const Invariant*, NodeId>> bounds_;  ///< The bounds of `species_`.
};

}  // namespace

}  // namespace lowering

SweepForm euler_form() {
    SweepForm form;
    const SweepTerm value{SweepTerm::Source::value, 0, SweepTerm::Weight::one, 0};
    const SweepTerm change{SweepTerm::Source::rate, 0, SweepTerm::Weight::speed, 0};
    form.outputs.push_back({SweepOutput::Kind::state, {value, change}});
    return form;
}

StepPlan plan_sweep(const Program& program, std::uint32_t stage, const SweepForm& form,
                    const PlanOptions& options) {
    return lowering::SweepEmitter(program, stage, form).plan(options);
}

StepPlan plan_step(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    return plan_sweep(program, stage, euler_form(), options);
}

}  // namespace cascade
