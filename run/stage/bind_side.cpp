// Copies the planes that a side's formula reads and that do not change to strips along the side.
#include "run/stage/bind_side.h"

#include "core/check.h"
#include "core/side_cells.h"
#include "run/stage/plan_runner.h"

namespace cascade {

ChangingSide bind_side(const SidePlans& plans, std::uint32_t stage, SpeciesId species, Side side,
                       const Compile& compile, const BindingContext& context, Team& team) {
    const IdVector<StepInvariantId, Field> step_invariants(
        run_plan(plans.once, compile, context, context.grid, team));
    CHECK(plans.each.passes.size() == 1, "a side's value takes one pass");
    const BoundKernel& bound = plans.each.passes[0].bound;
    ChangingSide changing;
    changing.species = species;
    changing.side = side;
    changing.kernel = compile(*bound.kernel);
    changing.precision = context.precision;
    changing.varies = !plans.each.is_uniform;
    const StageState& own = context.states[stage];
    for (const PlaneSource& source : bound.fields) {
        const auto* const item = std::get_if<StageItem>(&source);
        const bool is_own = item != nullptr && item->stage == stage;
        changing.reads.push_back(is_own ? own.species_of_item[item->item] : std::nullopt);
        if (changing.reads.back()) {
            changing.strips.emplace_back();
            continue;
        }
        const auto* const id = std::get_if<StepInvariantId>(&source);
        const Field& plane = id != nullptr ? step_invariants[*id] : plane_of(source, context);
        std::vector<double>& strip = changing.strips.emplace_back(values_beside(plane, side));
        strip.resize(strip.size() + PlaneLayout::row_pad);  // Kernels read whole vectors.
    }
    for (const UniformSource& source : bound.uniforms) {
        const auto slot = static_cast<std::uint32_t>(changing.uniforms.size());
        double& value = changing.uniforms.emplace_back(0);
        if (const auto* const each = std::get_if<StageItem>(&source)) {
            value = context.states[each->stage].numbers[each->item];
        } else if (const auto* const id = std::get_if<StepInvariantId>(&source)) {
            value = step_invariants[*id].number_at(0, 0);
        } else if (source == UniformSource(TimeValue::time)) {
            changing.time_slot = slot;
        } else {
            CHECK(source == UniformSource(TimeValue::step),
                  "a side's value knows numbers, t and step");
            changing.step_slot = slot;
        }
    }
    return changing;
}

}  // namespace cascade
