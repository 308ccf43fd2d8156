// Computes the values that change from step to step.
#include "device/pass_values.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "ir/draw_of_step.h"

#include <optional>

namespace cascade {

template <typename Number>
Number passed_value(const StepProblem::ChangingUniform& uniform, const StepMoment& moment) {
    return std::visit(
        Overloaded{
            [&](StepProblem::CompleteSteps) { return static_cast<Number>(moment.complete); },
            [&](StepProblem::StepDraw) { return draw_uniform<Number>(moment.complete); },
            [&](StepProblem::MomentAt at) {
                return static_cast<Number>(moment.t + at.part * moment.length);
            },
            [&](Sweep::Coefficient by) {
                return static_cast<Number>(by.times_step ? by.value * moment.length : by.value);
            },
            // The kernel reads aggregates from their buffer.
            [](AggregateId) { return Number{0}; },
        },
        uniform.value);
}

template float passed_value<float>(const StepProblem::ChangingUniform&, const StepMoment&);
template double passed_value<double>(const StepProblem::ChangingUniform&, const StepMoment&);

SideRules halo_rules_at(const StepProblem& problem, const StepProblem::Result& result,
                        const StepMoment& moment) {
    const auto* const own = std::get_if<StepProblem::SpeciesPlane>(&result.plane);
    if (own == nullptr && !result.rules) return problem.sides_of(result);
    const bool is_next = result.read_at == StepProblem::Result::next_step;
    const SideMoment when{is_next ? moment.complete + 1 : moment.complete,
                          is_next ? moment.next_t : moment.t + result.read_at * moment.length};
    const SpeciesPlanes none(problem.species_needs_halo.size());
    return problem.sides_of(own != nullptr ? own->species : *result.rules, when, none,
                            Patch{PlaneLayout(problem.grid).rows});
}

HaloRecords::HaloRecords(const std::vector<SideRules>& rules) {
    for (const SideRules& each : rules) {
        for (const SideRule& rule : each.at) kinds.push_back(static_cast<std::int32_t>(rule.kind));
        for (const SideRule& rule : each.at) {
            numbers.push_back(rule.value);
            if (!rule.has_value() || !rule.values) {
                kinds.push_back(-1);
                continue;
            }
            const SideValues& along = *rule.values;
            CHECK(along.first == 0, "the rules of a whole plane begin at its first cell");
            kinds.push_back(static_cast<std::int32_t>(values.size()));
            values.insert(values.end(), along.numbers.begin(), along.numbers.end());
        }
        numbers.push_back(each.spacing);
    }
}

}  // namespace cascade
