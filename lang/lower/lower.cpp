// The plans of a stage: its start, its step and its rates.
#include "lang/lower/lower.h"

#include "core/check.h"
#include "lang/lower/lower_formula.h"
#include "lang/lower/plan_builder.h"
#include "lang/lower/step_invariants.h"
#include "lang/program/dependencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace cascade {

namespace {

using namespace lowering;

/// What a view has outside of the mask.
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

std::vector<std::uint32_t> species_items(const System& system) {
    std::vector<std::uint32_t> items;
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (system.quantities[item].is_species) items.push_back(item);
    }
    return items;
}

/// The uniform items that need an aggregate over the domain, directly or through others: they can
/// be computed only where there are cells.
std::vector<bool> items_of_aggregates(const Stage& stage) {
    std::vector<bool> late(stage.items.size(), false);
    for (const std::uint32_t item : stage.order) {
        if (!stage.uniform[item]) continue;
        for (const Node& node : stage.items[item].nodes) {
            const bool takes_one = node.kind == NodeKind::call && info(node.function).is_aggregate;
            const bool reads_one = node.kind == NodeKind::own && late[node.index];
            if (takes_one || reads_one) late[item] = true;
        }
    }
    return late;
}

/// What is written where: inside the mask the value, outside of it what is said here.
ValueId within_mask(KernelAssembly& assembly, ValueId value, float outside) {
    if (!assembly.program().domain.mask) return value;
    KernelBuilder& builder = assembly.builder();
    return builder.select(assembly.inside({}), value, builder.number(outside));
}

/// Starting values in order; `is_chosen(item)` says which become results. Items that are computed
/// elsewhere are read.
template <typename Chosen>
StepPlan plan_items(const Program& program, std::uint32_t stage, const PlanOptions& options,
                    const Chosen& is_chosen) {
    const Stage& source = program.stages[stage];
    const System& system = program.system_of(stage);
    PartGraph graph(program, stage);
    std::vector<std::uint32_t> items;
    std::vector<PartId> parts;
    for (const std::uint32_t item : source.order) {
        if (!is_chosen(item)) continue;
        const PartId part =
            graph.add(source.items[item], {std::string(system.item_name(item)), false});
        graph.set_own(item, part);
        items.push_back(item);
        parts.push_back(part);
    }
    StepPlan plan = build_plan({graph, parts, options}, [&](KernelAssembly& assembly,
                                                            const PassLowering& values) {
        for (std::size_t k = 0; k < items.size(); ++k) {
            const ValueId value = values.value(parts[k])[0];
            assembly.result(std::string(system.item_name(items[k])),
                            source.uniform[items[k]] ? value : within_mask(assembly, value, 0));
        }
    });
    plan.results = std::move(items);
    return plan;
}

/// All formulas of a stage's step: every plan of it numbers their parts alike.
struct StepGraph {
    PartGraph graph;
    std::vector<PartId> rates;            ///< By item.
    std::vector<PartId> bounds;           ///< By invariant.
    std::vector<PartId> step_invariants;  ///< What is computed once.

    StepGraph(const Program& program, std::uint32_t stage, const PlanOptions& options)
        : graph(program, stage) {
        const System& system = program.system_of(stage);
        add_rates(system);
        for (const Invariant& invariant : system.invariants) {
            bounds.push_back(graph.add(invariant.bound, {}));
        }
        if (!options.keeps_step_invariants) return;
        std::vector<PartId> all = bounds;
        for (const std::uint32_t item : system.rate_order) all.push_back(rates[item]);
        step_invariants = step_invariant_parts(graph, all);
    }

private:
    /// Adds definitions and rates in an order in which each can be computed. Those that nothing
    /// needs stay out of the kernels.
    void add_rates(const System& system) {
        const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
        rates.resize(system.quantities.size());
        for (const std::uint32_t value : topological_order(step_dependencies(system)).order) {
            if (value < definition_count) {
                const Definition& definition = system.definitions[value];
                graph.set_definition(value, graph.add(definition.formula, {definition.name, true}));
                continue;
            }
            const std::uint32_t item = value - definition_count;
            if (!system.is_species(item)) continue;
            rates[item] = graph.add(system.rates[item], {system.quantities[item].name + "'", true});
            graph.set_rate(item, rates[item]);
        }
    }
};

/// The results of a sweep: what its form says of the rates and inputs of every species.
class SweepEmitter {
public:
    SweepEmitter(const Program& program, std::uint32_t stage, const SweepForm& form)
        : program_(program), stage_(stage), form_(form), system_(program.system_of(stage)) {
        const std::vector<std::uint32_t> all = species_items(system_);
        species_ = all;
        if (!form.species.empty()) {
            species_.clear();
            for (const std::uint32_t number : form.species) species_.push_back(all[number]);
        }
    }

    StepPlan plan(const PlanOptions& options) {
        const StepGraph step(program_, stage_, options);
        rates_ = step.rates;
        std::vector<PartId> wanted;
        for (const std::uint32_t item : system_.rate_order) {
            if (!is_written(item)) continue;
            if (form_.uses_rates() || (form_.holds && is_bounded(item)))
                wanted.push_back(rates_[item]);
        }
        for (std::size_t k = 0; k < system_.invariants.size(); ++k) {
            if (!is_written(system_.invariants[k].species)) continue;
            bounds_.push_back({&system_.invariants[k], step.bounds[k]});
            wanted.push_back(step.bounds[k]);
        }
        const std::vector<std::uint32_t> slots = species_items(system_);
        StepPlan plan = build_plan({step.graph, wanted, options, true, slots, step.step_invariants,
                                    program_.domain.fast},
                                   [&](KernelAssembly& assembly, const PassLowering& values) {
                                       for (std::size_t o = 0; o < form_.outputs.size(); ++o)
                                           emit(assembly, values, o);
                                   });
        for (std::size_t o = 0; o < form_.outputs.size(); ++o) {
            plan.results.insert(plan.results.end(), species_.begin(), species_.end());
        }
        return plan;
    }

private:
    bool is_bounded(std::uint32_t item) const {
        return std::any_of(system_.invariants.begin(), system_.invariants.end(),
                           [&](const Invariant& invariant) { return invariant.species == item; });
    }

    bool is_written(std::uint32_t item) const {
        return std::find(species_.begin(), species_.end(), item) != species_.end();
    }

    ValueId base(KernelAssembly& assembly, std::uint32_t item) const {
        return assembly.input(form_.base_input, item);
    }

    ValueId term(KernelAssembly& assembly, const PassLowering& values, const SweepTerm& term,
                 SweepOutput::Kind kind, std::uint32_t item) const {
        KernelBuilder& builder = assembly.builder();
        ValueId value{};
        switch (term.source) {
            case SweepTerm::Source::value: value = assembly.input(term.input, item); break;
            case SweepTerm::Source::difference:
                value = builder.subtract(assembly.input(term.input, item), base(assembly, item));
                break;
            case SweepTerm::Source::rate:
                value = values.value(rates_[item])[0];
                // A method that puts a step together from rates, or filters them, would otherwise
                // let a held cell pull at others.
                if (kind != SweepOutput::Kind::change) break;
                if (const auto held = is_held(assembly, values, item)) {
                    value = builder.select(*held, builder.number(0), value);
                }
                break;
        }
        switch (term.weight) {
            case SweepTerm::Weight::one: return value;
            case SweepTerm::Weight::speed:
                return builder.multiply(assembly.own_item(system_.speed_item()), value);
            case SweepTerm::Weight::coefficient:
                return builder.multiply(assembly.coefficient(term.coefficient), value);
        }
        CHECK(false, "lowering: every weight has a meaning");
    }

    void emit(KernelAssembly& assembly, const PassLowering& values, std::size_t number) const {
        KernelBuilder& builder = assembly.builder();
        const SweepOutput& output = form_.outputs[number];
        std::vector<ValueId> next(system_.quantities.size());
        for (const std::uint32_t item : species_) {
            std::optional<ValueId> sum;
            for (const SweepTerm& each : output.terms) {
                const ValueId value = term(assembly, values, each, output.kind, item);
                sum = sum ? builder.add(*sum, value) : value;
            }
            CHECK(sum, "lowering: an output has terms");
            next[item] = *sum;
        }
        if (output.kind == SweepOutput::Kind::state) {
            if (form_.holds) hold(assembly, values, next);
            clamp(assembly, values, next);
        }
        const bool freezes = !assembly.stage().uniform[system_.frozen_item()];
        for (const std::uint32_t item : species_) {
            if (freezes) {
                const ValueId kept = output.kind == SweepOutput::Kind::state ? base(assembly, item)
                                                                             : builder.number(0);
                next[item] =
                    builder.select(assembly.own_item(system_.frozen_item()), kept, next[item]);
            }
            assembly.result(system_.quantities[item].name, within_mask(assembly, next[item], 0));
        }
    }

    void hold(KernelAssembly& assembly, const PassLowering& values,
              std::vector<ValueId>& next) const {
        for (const std::uint32_t item : species_) {
            if (const auto held = is_held(assembly, values, item)) {
                next[item] = assembly.builder().select(*held, base(assembly, item), next[item]);
            }
        }
    }

    /// Invariants in order of writing.
    void clamp(KernelAssembly& assembly, const PassLowering& values,
               std::vector<ValueId>& next) const {
        KernelBuilder& builder = assembly.builder();
        for (const auto& [invariant, part] : bounds_) {
            const ValueId bound = values.value(part)[0];
            ValueId& value = next[invariant->species];
            value = invariant->at_least ? builder.clamp_below(value, bound)
                                        : builder.clamp_above(value, bound);
        }
    }

    /// Does a value stand at a bound in input 0, which its rate would carry it beyond? Empty where
    /// nothing bounds it.
    std::optional<ValueId> is_held(KernelAssembly& assembly, const PassLowering& values,
                                   std::uint32_t item) const {
        KernelBuilder& builder = assembly.builder();
        const ValueId zero = builder.number(0);
        std::optional<ValueId> held;
        for (const auto& [invariant, part] : bounds_) {
            if (invariant->species != item) continue;
            const bool at_least = invariant->at_least;
            const ValueId bound = values.value(part)[0];
            const ValueId value = assembly.input(0, item), rate = values.value(rates_[item])[0];
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
    std::vector<std::uint32_t> species_;                       ///< Items that are written.
    std::vector<PartId> rates_;                                ///< By item.
    std::vector<std::pair<const Invariant*, PartId>> bounds_;  ///< Of species that are written.
};

}  // namespace

StepPlan plan_uniform_start(const Program& program, std::uint32_t stage) {
    const Stage& source = program.stages[stage];
    const std::vector<bool> late = items_of_aggregates(source);
    return plan_items(program, stage, {},
                      [&](std::uint32_t item) { return source.uniform[item] && !late[item]; });
}

StepPlan plan_start(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    const Stage& source = program.stages[stage];
    const std::vector<bool> late = items_of_aggregates(source);
    return plan_items(program, stage, options,
                      [&](std::uint32_t item) { return !source.uniform[item] || late[item]; });
}

SweepForm euler_form() {
    SweepForm form;
    const SweepTerm value{SweepTerm::Source::value, 0, SweepTerm::Weight::one, 0};
    const SweepTerm change{SweepTerm::Source::rate, 0, SweepTerm::Weight::speed, 0};
    form.outputs.push_back({SweepOutput::Kind::state, {value, change}});
    return form;
}

StepPlan plan_sweep(const Program& program, std::uint32_t stage, const SweepForm& form,
                    const PlanOptions& options) {
    return SweepEmitter(program, stage, form).plan(options);
}

StepPlan plan_step(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    return plan_sweep(program, stage, euler_form(), options);
}

StepPlan plan_rates(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    const System& system = program.system_of(stage);
    const StepGraph step(program, stage, options);
    const std::vector<std::uint32_t> species = species_items(system);
    std::vector<PartId> wanted;
    for (const std::uint32_t item : system.rate_order) wanted.push_back(step.rates[item]);
    StepPlan plan = build_plan(
        {step.graph, wanted, options, true, species, step.step_invariants},
        [&](KernelAssembly& assembly, const PassLowering& values) {
            for (const std::uint32_t item : species) {
                assembly.result(system.quantities[item].name,
                                within_mask(assembly, values.value(step.rates[item])[0], 0));
            }
        });
    plan.results = species;
    return plan;
}

StepPlan plan_step_invariants(const Program& program, std::uint32_t stage,
                              const PlanOptions& options) {
    const StepGraph step(program, stage, options);
    StepPlan plan =
        build_plan({step.graph, step.step_invariants, options, true},
                   [&](KernelAssembly& assembly, const PassLowering& values) {
                       for (std::size_t k = 0; k < step.step_invariants.size(); ++k) {
                           const std::string& name = step.graph.name(step.step_invariants[k]);
                           assembly.result(name.empty() ? fmt::format("(step-invariant {})", k)
                                                        : name,
                                           values.value(step.step_invariants[k])[0]);
                       }
                   });
    for (PassTarget& target : plan.passes.back().targets) {
        if (target.kind != PassTarget::Kind::result) continue;
        const PartId part = step.step_invariants[target.index];
        target.is_uniform = step.graph[part].is_uniform;
        target.boundary = step.graph.boundary(part);
    }
    return plan;
}

SidePlans plan_side(const Program& program, const SideSetting& setting, Side side,
                    std::uint32_t stage) {
    SidePlans plans;
    PartGraph graph(program, stage, Invariance::state);
    PartId part = graph.add(setting.value, {});
    if (setting.kind == SideKind::flux) part = graph.across_side(part, side);
    const std::array wanted{part};
    std::vector<PartId> step_invariants;
    plans.changes = !graph[part].is_step_invariant;
    if (plans.changes) step_invariants = largest_step_invariants(graph, wanted);
    plans.once = build_plan({graph, step_invariants, {}},
                            [&](KernelAssembly& assembly, const PassLowering& values) {
                                for (const PartId each : step_invariants)
                                    assembly.result("step-invariant", values.value(each)[0]);
                            });
    plans.each = build_plan({graph, wanted, {}, false, {}, step_invariants},
                            [&](KernelAssembly& assembly, const PassLowering& values) {
                                assembly.result("value", values.value(part)[0]);
                            });
    return plans;
}

StepPlan plan_view(const Program& program, std::span<const Formula* const> formulas,
                   std::uint32_t stage, const PlanOptions& options) {
    PartGraph graph(program, stage);
    std::vector<PartId> parts;
    for (const Formula* formula : formulas) parts.push_back(graph.add(*formula, {}));
    return build_plan({graph, parts, options}, [&](KernelAssembly& assembly,
                                                   const PassLowering& values) {
        static constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
        for (const PartId part : parts) {
            const bool is_number = graph[part].node.type != ValueType::colour;
            for (std::size_t channel = 0; channel < (is_number ? 1 : 3); ++channel) {
                const ValueId value = values.value(part)[channel];
                assembly.result(is_number ? "value" : channels[channel],
                                graph[part].is_uniform ? value
                                                       : within_mask(assembly, value, nothing));
            }
        }
    });
}

StepPlan plan_mask(const Program& program) {
    CHECK(program.domain.mask, "lowering: the domain has a mask");
    PartGraph graph(program, 0, Invariance::parameters, Extent::grid);
    const PartId part = graph.add(program.domain.mask->formula, {"mask", false, "domain"});
    return build_plan({graph, std::span(&part, 1), {}},
                      [&](KernelAssembly& assembly, const PassLowering& values) {
                          assembly.result("mask", values.value(part)[0]);
                      });
}

StepPlan plan_view(const Program& program, const Formula& formula, std::uint32_t stage) {
    const Formula* only = &formula;
    return plan_view(program, std::span(&only, 1), stage);
}

std::string describe_plans(const Program& program) {
    const PlanOptions options{Materialise::when_cheaper, true, true};
    std::string text;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const std::string& name = program.stages[k].name;
        text += fmt::format("stage '{}', starting values: {}\n", name,
                            plan_start(program, k, options).words);
        if (const StepPlan once = plan_step_invariants(program, k, options);
            once.result_count > 0) {
            text += fmt::format("stage '{}', once before the first step: {}\n", name, once.words);
        }
        text +=
            fmt::format("stage '{}', one step: {}\n", name, plan_step(program, k, options).words);
    }
    return text;
}

}  // namespace cascade
