// Builds vectors, frames and values of links from nodes. Equal expressions become one node, so a
// value may be requested any number of times.
#include "lang/lower/tissue_numbers.h"

#include <array>

namespace cascade::lowering {

TermVector TissueNumbers::items(ItemId first) {
    const auto item = [&](std::size_t k) { return leaf(ItemId(first.index() + k)); };
    return {item(0), item(1), item(2)};
}

/// Column `axis` of the matrix of the rotation q / |q|, for the quaternion q = (w, x, y, z). For ex
/// it is (1 − 2 (y² + z²)/|q|², 2 (xy + wz)/|q|², 2 (xz − wy)/|q|²). The other axes follow by
/// cyclic exchange.
TermVector TissueNumbers::axis(std::size_t axis) {
    std::array<Term, 4> q;
    for (std::size_t k = 0; k < 4; ++k) q[k] = leaf(ItemId(rules_.frame.index() + k));
    Term squares = square(q[0]);
    for (std::size_t k = 1; k < 4; ++k) squares = squares + square(q[k]);
    const Term twice = leaf(2.0) / squares;
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Term own = q[axis + 1], b = q[next + 1], c = q[last + 1];
    TermVector result;
    result[axis] = leaf(1.0) - twice * (b * b + c * c);
    result[next] = twice * (own * b + q[0] * c);
    result[last] = twice * (own * c - q[0] * b);
    return result;
}

Term TissueNumbers::theirs(Term plane) {
    return graph_.is_number(plane) ? plane : Term::call(Function::theirs, plane);
}

TermVector TissueNumbers::apart() {
    const DomainSettings& domain = context_.program.domain;
    const Grid& grid = domain.grid;
    const std::array sides{grid.width, grid.height, grid.depth};
    const std::array boundaries{grid.boundary.x, grid.boundary.y, grid.boundary.z};
    TermVector apart = place();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = theirs(apart[axis]) - apart[axis];
        if (domain.model || sides[axis] == 1 || boundaries[axis] != Boundary::periodic) continue;
        // Subtracts the nearest multiple of the period.
        const auto period =
            static_cast<double>(sides[axis]) / static_cast<double>(grid.longest_side());
        const Term periods = period == 1 ? apart[axis] : apart[axis] / leaf(period);
        const Term whole = round(periods);
        apart[axis] = apart[axis] - (period == 1 ? whole : whole * leaf(period));
    }
    return apart;
}

/// The sum r + r' of both radii.
Term TissueNumbers::radii() {
    const Term radius = leaf(rules_.radius);
    return radius + theirs(radius);
}

Term TissueNumbers::contact() {
    if (!(rules_.reach > 1)) {
        const Term distance = this->distance();
        return less_equal(distance, radii());
    }
    const Term left = leaf(rules_.reach) - distance() / radii();
    const Term rise = left * leaf(1 / (rules_.reach - 1)), zero = leaf(0.0);
    return clamp(rise, zero, leaf(1.0));
}

}  // namespace cascade::lowering
