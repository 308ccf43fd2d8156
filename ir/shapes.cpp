// Shapes, computed from the cell's distances to their centres along the axes.
#include "ir/expression.h"
#include "ir/space.h"

#include <algorithm>
#include <optional>

namespace cascade {
namespace {

/// The signed distance from `centre` to the cell along one axis. Along a periodic axis the nearest
/// multiple of the period is subtracted, which gives the shortest distance.
Expression distance_along(KernelBuilder& builder, const SpaceAxis& axis, ValueId centre) {
    const Expression distance = Expression(builder, axis.coordinate) - Expression(builder, centre);
    if (!axis.is_periodic) return distance;
    const Rounded periods = round_to_whole(distance / distance.number(axis.length));
    return distance - periods.number * axis.length;
}

Expression squared_distance(KernelBuilder& builder, const Space& space,
                            std::span<const ValueId> centre) {
    std::optional<Expression> sum;
    for (std::size_t k = 0; k < centre.size(); ++k) {
        if (!space[k].has_extent) continue;
        const Expression along = distance_along(builder, space[k], centre[k]);
        sum = sum ? *sum + along * along : along * along;
    }
    return sum ? *sum : Expression(builder, builder.number(0));
}

/// |distance| < width / 2.
Expression within_half(Expression distance, Expression width) {
    return distance.absolute() < width * 0.5;
}

}  // namespace

ValueId disc(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius) {
    const Expression r(builder, radius);
    return (squared_distance(builder, space, centre) < r * r).id();
}

ValueId ring(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
             ValueId radius, ValueId width) {
    const Expression distance = squared_distance(builder, space, centre).unary(Op::square_root);
    const Expression r(builder, radius);
    return within_half(distance - r, Expression(builder, width)).id();
}

ValueId box(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
            std::span<const ValueId> size) {
    std::optional<Expression> inside;
    for (std::size_t k = 0; k < centre.size(); ++k) {
        if (!space[k].has_extent) continue;
        const Expression along =
            within_half(distance_along(builder, space[k], centre[k]), Expression(builder, size[k]));
        inside = inside ? both(*inside, along) : along;
    }
    return inside ? inside->id() : builder.number(1);
}

ValueId gauss(KernelBuilder& builder, const Space& space, std::span<const ValueId> centre,
              ValueId width) {
    const Expression w(builder, width);
    const Expression squared = squared_distance(builder, space, centre);
    return builder.exponential(((squared * -0.5) / (w * w)).id());
}

ValueId stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width) {
    return box(builder, space, {&position, 1}, {&width, 1});
}

ValueId turned_stripe(KernelBuilder& builder, const Space& space, ValueId position, ValueId width,
                      ValueId angle) {
    const Expression x(builder, space[0].coordinate);
    const Expression y(builder, space[1].coordinate);
    const Expression along = x * Expression(builder, builder.cosine(angle)) +
                             y * Expression(builder, builder.sine(angle));
    return within_half(along - Expression(builder, position), Expression(builder, width)).id();
}

}  // namespace cascade
