// Equal expressions become one node of the graph, so each value may be asked for again and again.
#include "lang/lower/tissue_numbers.h"

namespace cascade::lowering {

TissueNumbers::TissueNumbers(ExpressionGraph& graph, const PassContext& context)
    : graph_(graph), context_(context), rules_(*context.program.system_of(context.stage).cells) {}

NodeId TissueNumbers::dot(const Parts& a, const Parts& b) {
    return sum(sum(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));
}

TissueNumbers::Parts TissueNumbers::cross(const Parts& a, const Parts& b) {
    const auto minor = [&](std::size_t i, std::size_t j) {
        return difference(times(a[i], b[j]), times(a[j], b[i]));
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

/// v · (1/length), which takes one division; 0 for 0.
TissueNumbers::Parts TissueNumbers::unit(const Parts& v) {
    const NodeId size = length(v), zero = number(0);
    const NodeId inverse = choice(less(zero, size), quotient(number(1), size), zero);
    return {times(v[0], inverse), times(v[1], inverse), times(v[2], inverse)};
}

TissueNumbers::Parts TissueNumbers::items(ItemId first) {
    const auto item = [&](std::size_t k) { return graph_.leaf(ItemId(first.index() + k)); };
    return {item(0), item(1), item(2)};
}

/// A column of the rotation matrix of the quaternion q = (w, x, y, z), divided by |q|²: for ex
/// (1 − 2 (y² + z²)/|q|², 2 (xy + wz)/|q|², 2 (xz − wy)/|q|²), and so on in turn.
TissueNumbers::Parts TissueNumbers::axis(std::size_t axis) {
    std::array<NodeId, 4> q{};
    for (std::size_t k = 0; k < 4; ++k) q[k] = graph_.leaf(ItemId(rules_.frame.index() + k));
    NodeId squares = times(q[0], q[0]);
    for (std::size_t k = 1; k < 4; ++k) squares = sum(squares, times(q[k], q[k]));
    const NodeId twice = quotient(number(2), squares);
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    const NodeId own = q[axis + 1], b = q[next + 1], c = q[last + 1];
    Parts result{};
    result[axis] = difference(number(1), times(twice, sum(times(b, b), times(c, c))));
    result[next] = times(twice, sum(times(own, b), times(q[0], c)));
    result[last] = times(twice, difference(times(own, c), times(q[0], b)));
    return result;
}

NodeId TissueNumbers::theirs(NodeId plane) {
    return graph_.is_number(plane) ? plane : graph_.call(Function::theirs, {plane});
}

TissueNumbers::Parts TissueNumbers::apart() {
    const DomainSettings& domain = context_.program.domain;
    const Grid& grid = domain.grid;
    const std::array sides{grid.width, grid.height, grid.depth};
    const std::array boundaries{grid.boundary.x, grid.boundary.y, grid.boundary.z};
    Parts apart = place();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = difference(theirs(apart[axis]), apart[axis]);
        if (domain.model || sides[axis] == 1 || boundaries[axis] != Boundary::periodic) continue;
        apart[axis] = nearest(apart[axis], static_cast<double>(sides[axis]) /
                                               static_cast<double>(grid.longest_side()));
    }
    return apart;
}

/// Less the nearest whole number of periods.
NodeId TissueNumbers::nearest(NodeId apart, double period) {
    const bool is_one = period == 1;
    const NodeId periods = is_one ? apart : quotient(apart, number(period));
    const NodeId whole = graph_.call(Function::round, {periods});
    return difference(apart, is_one ? whole : times(whole, number(period)));
}

/// r + r'.
NodeId TissueNumbers::radii() {
    const NodeId radius = graph_.leaf(rules_.radius);
    return sum(radius, theirs(radius));
}

NodeId TissueNumbers::overlap() {
    return larger(graph_.call(Function::negate, {gap()}), number(0));
}

NodeId TissueNumbers::contact() {
    if (!(rules_.reach > 1)) return graph_.call(Function::less_equal, {distance(), radii()});
    const NodeId left = difference(number(rules_.reach), quotient(distance(), radii()));
    return graph_.call(Function::clamp,
                       {times(left, number(1 / (rules_.reach - 1))), number(0), number(1)});
}

}  // namespace cascade::lowering
