// Binds all sweeps of a scheme as one problem.
#include "run/stage/plan_binder.h"

#include <algorithm>

namespace cascade {

namespace {

/// Marks the registers at which rates are evaluated, because these need a halo: the registers of
/// stages, the old step, and the new step, which becomes the old one. Stored rates and errors are
/// read only in the cell itself.
IdVector<RegisterId, bool> halo_registers(const Scheme& scheme) {
    IdVector<RegisterId, bool> registers(scheme.registers, false);
    registers[old_register] = registers[new_register] = true;
    for (const Sweep& sweep : scheme.sweeps) registers[sweep.inputs[0]] = true;
    return registers;
}

/// Whether the rates at the end of a step are, bit for bit, the rates at the start of the next
/// step. This is not so if rates read the number or the length of the step.
bool rates_go_on(const StepPlan& plan) {
    for (const Pass& pass : plan.passes) {
        for (const UniformSource& source : pass.bound.uniforms) {
            const auto* const value = std::get_if<TimeValue>(&source);
            if (value != nullptr && *value != TimeValue::time) return false;
        }
    }
    return true;
}

/// Returns, for each output of a sweep, the moment for which its halo is filled. This is the moment
/// of the next sweep that reads the output. The new step is read when the next step begins.
std::vector<double> moments_of_outputs(const Scheme& scheme, std::size_t number) {
    const std::span<const Sweep> later(scheme.sweeps.begin() + number + 1, scheme.sweeps.end());
    std::vector<double> moments;
    for (const RegisterId output : scheme.sweeps[number].outputs) {
        const auto reads = [&](const Sweep& sweep) { return sweep.inputs[0] == output; };
        const auto writes = [&](const Sweep& sweep) {
            return std::find(sweep.outputs.begin(), sweep.outputs.end(), output) !=
                   sweep.outputs.end();
        };
        const bool stays =
            output == new_register && std::none_of(later.begin(), later.end(), writes);
        const auto reader = std::find_if(later.begin(), later.end(), reads);
        moments.push_back(stays || reader == later.end() ? StepProblem::Result::next_step
                                                         : reader->time);
    }
    return moments;
}

}  // namespace

StepProblem bind_scheme(const Scheme& scheme, std::span<const StepPlan> plans,
                        const StepPlan& before, const Compile& compile,
                        const BindingContext& context, const System& system, std::uint32_t stage) {
    std::vector<PlanBinder> binders;
    StepProblem whole;
    whole.grid = context.grid;
    whole.cells_inside = cells_inside(context);
    whole.precision = context.precision;
    whole.registers = scheme.registers;
    whole.error_register = scheme.error_register;
    whole.curve = scheme.curve;
    take_sides(whole, context, system, stage);
    std::vector<const Sweep*> sweeps;
    std::vector<const StepPlan*> all;
    const auto add = [&](const StepPlan& plan, const SweepForm* form, const Sweep* sweep,
                         std::vector<double> read_at) {
        PlanBinder& binder =
            binders.emplace_back(plan, context, &system, stage, form, sweep, std::move(read_at));
        sweeps.push_back(sweep);
        all.push_back(&plan);
        for (std::size_t k = 0; k < whole.species_needs_halo.size(); ++k) {
            if (binder.species_needs_halo()[k]) whole.species_needs_halo[k] = true;
        }
    };
    // If a step already has the rates at its start, it skips its first passes. So the sweep of
    // these rates comes first, before the passes of `before`.
    const std::size_t needs_before = scheme.rate_registers ? 1 : 0;
    for (std::size_t n = 0; n < scheme.sweeps.size(); ++n) {
        if (n == needs_before && !before.passes.empty()) add(before, nullptr, nullptr, {});
        const Sweep& sweep = scheme.sweeps[n];
        add(plans[sweep.form], &scheme.forms[sweep.form], &sweep, moments_of_outputs(scheme, n));
    }
    const IdVector<RegisterId, bool> with_halo = halo_registers(scheme);
    std::size_t first_passes = 0;  // The number of passes in the first sweep.
    for (std::size_t n = 0; n < binders.size(); ++n) {
        binders[n].species_needs_halo() = whole.species_needs_halo;
        binders[n].set_halo_registers(with_halo);
        StepProblem part = binders[n].bind(compile);
        if (n == 0) first_passes = part.passes.size();
        whole.temporaries = std::max(whole.temporaries, part.temporaries);
        whole.aggregates = std::max(whole.aggregates, part.aggregates);
        if (sweeps[n] != nullptr) part.passes.front().filter = sweeps[n]->filter;
        for (StepProblem::Pass& pass : part.passes) whole.passes.push_back(std::move(pass));
    }
    // Links with additional weights can also be used by plans that do not read these weights.
    whole.links = links_of(context, all);
    if (scheme.rate_registers) {
        const StepPlan& first = plans[scheme.sweeps[0].form];
        if (rates_go_on(first)) {
            whole.first_rate_passes = first_passes;
            whole.rate_registers = scheme.rate_registers;
        }
    }
    return whole;
}

}  // namespace cascade
