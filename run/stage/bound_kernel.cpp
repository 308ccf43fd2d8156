// Finds the planes of slots, and binds plans outside of schemes.
#include "run/stage/bound_kernel.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "run/stage/plan_binder.h"

namespace cascade {

const Field& plane_of(const PlaneSource& source, const BindingContext& context) {
    const Overloaded plane{
        [&](StageItem each) { return &context.states[each.stage].field(each.item); },
        [&](NamedPlane each) { return &context.files.plane(each); },
        [&](SurfaceValueId id) { return &context.surface_values->value(id); },
        [&](MetricPlane of) { return &context.metric[static_cast<std::size_t>(of)]; },
        [&](ModelPlane of) {
            return is_made_when_read(of)
                       ? &context.surface_values->plane(of)
                       : &context.model->spread().planes[static_cast<std::size_t>(of)];
        },
        [&](Neighbourhood) { return &context.mask->neighbourhood; },
        [&](Unknown) { return context.unknown; },
        [&](LagPart part) { return &context.lags[static_cast<std::size_t>(part)]; },
        [&](StepInvariantId id) { return &(*context.step_invariants)[id].plane; },
        [](SensedItem) -> const Field* { CHECK(false, "cells of fields stay where they are"); },
        [](auto) -> const Field* { CHECK(false, "registers and temporaries are no fields"); },
    };
    return *std::visit(plane, source);
}

StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context,
                      const System& system, std::uint32_t stage) {
    return PlanBinder(plan, context, &system, stage).bind(compile);
}

StepProblem bind_plan(const StepPlan& plan, const Compile& compile, const BindingContext& context) {
    return PlanBinder(plan, context, nullptr, 0).bind(compile);
}

std::string species_name(const System& system, std::size_t species) {
    return system.quantities[system.species()[SpeciesId(species)]].name;
}

}  // namespace cascade
