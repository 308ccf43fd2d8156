// Copies the planes that a side's formula reads to strips along the side, once.
#include "run/stage/bind_side.h"

#include "core/check.h"
#include "run/stage/plan_runner.h"

namespace cascade {

namespace {

/// The values of a plane's cells beside a side.
std::vector<double> strip_of(const Field& field, Side side) {
    const PlaneLayout& layout = field.layout();
    const SideCells all = SideCells::of_rows(layout, side, {0, layout.row_count()});
    std::vector<double> strip(static_cast<std::size_t>(all.count + PlaneLayout::row_pad));
    field.visit([&](const auto& plane) {
        for (std::int64_t k = 0; k < all.count; ++k) {
            strip[static_cast<std::size_t>(k)] = plane.origin()[SideCells::offset(layout, side, k)];
        }
    });
    return strip;
}

}  // namespace

ChangingSide bind_side(const SidePlans& plans, std::uint32_t species, Side side,
                       const Compile& compile, const BindingContext& context, Team& team) {
    const IdVector<StepInvariantId, Field> step_invariants(
        run_plan(plans.once, compile, context, context.grid, team));
    CHECK(plans.each.passes.size() == 1, "a side's value takes one pass");
    const BoundKernel& bound = plans.each.passes[0].bound;
    ChangingSide changing;
    changing.species = species;
    changing.side = side;
    changing.kernel = compile(bound.kernel);
    changing.precision = context.precision;
    for (const PlaneSource& source : bound.fields) {
        const auto* const id = std::get_if<StepInvariantId>(&source);
        const Field& plane = id != nullptr ? step_invariants[*id] : plane_of(source, context);
        changing.strips.push_back(strip_of(plane, side));
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
