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
    const std::vector<Field> step_invariants =
        run_plan(plans.once, compile, context, context.grid, team);
    CHECK(plans.each.passes.size() == 1, "a side's value takes one pass");
    const BoundKernel& bound = plans.each.passes[0].bound;
    ChangingSide changing;
    changing.species = species;
    changing.side = side;
    changing.kernel = compile(bound.kernel);
    changing.precision = context.precision;
    for (const SlotSource& source : bound.fields) {
        const Field& plane = source.kind == SlotSource::Kind::step_invariant
                                 ? step_invariants[source.item]
                                 : plane_of(source, context);
        changing.strips.push_back(strip_of(plane, side));
    }
    for (const SlotSource& source : bound.uniforms) {
        const auto slot = static_cast<std::uint32_t>(changing.uniforms.size());
        double value = 0;
        switch (source.kind) {
            case SlotSource::Kind::item:
                value = context.states[source.stage].numbers[source.item];
                break;
            case SlotSource::Kind::step_invariant:
                value = step_invariants[source.item].number_at(0, 0);
                break;
            case SlotSource::Kind::time: changing.time_slot = slot; break;
            case SlotSource::Kind::step: changing.step_slot = slot; break;
            default: CHECK(false, "a side's value knows numbers, t and step");
        }
        changing.uniforms.push_back(value);
    }
    return changing;
}

}  // namespace cascade
