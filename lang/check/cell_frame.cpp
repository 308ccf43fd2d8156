// Quaternions by their products, written as expression graphs.
#include "lang/check/cell_frame.h"

#include "lang/calculus/algebra.h"

#include <numbers>

namespace cascade::checking {

namespace {

using Vector = std::array<NodeId, 3>;

/// Numbers and vectors of three numbers in one graph.
struct FrameAlgebra : Algebra {
    NodeId component(NodeId vector, std::size_t k) {
        return call(Function::component, {vector, number(static_cast<double>(k))});
    }
    Vector components(NodeId vector) {
        return {component(vector, 0), component(vector, 1), component(vector, 2)};
    }
    NodeId sum3(NodeId a, NodeId b, NodeId c) { return sum(sum(a, b), c); }
    NodeId dot(const Vector& a, const Vector& b) {
        return sum3(product(a[0], b[0]), product(a[1], b[1]), product(a[2], b[2]));
    }
    Vector cross(const Vector& a, const Vector& b) {
        const auto part = [&](std::size_t i, std::size_t j) {
            return difference(product(a[i], b[j]), product(a[j], b[i]));
        };
        return {part(1, 2), part(2, 0), part(0, 1)};
    }
    std::array<Formula, 4> formulas(const std::array<NodeId, 4>& roots) const {
        return {formula(roots[0]), formula(roots[1]), formula(roots[2]), formula(roots[3])};
    }
};

/// A quaternion.
struct Turn {
    NodeId w;
    Vector v;
};

/// The product a b: first the turn b, then a.
Turn product(FrameAlgebra& algebra, const Turn& a, const Turn& b) {
    const Vector across = algebra.cross(a.v, b.v);
    Turn result{algebra.difference(algebra.product(a.w, b.w), algebra.dot(a.v, b.v)), {}};
    for (std::size_t k = 0; k < 3; ++k) {
        result.v[k] =
            algebra.sum3(algebra.product(a.w, b.v[k]), algebra.product(b.w, a.v[k]), across[k]);
    }
    return result;
}

/// The shortest turn of the y axis of space to the unit vector `ey`; half a turn about x if that is
/// opposite.
Turn turn_of_y(FrameAlgebra& algebra, const Vector& ey) {
    // (1 + y · ey, y × ey), made a unit.
    const NodeId zero = algebra.number(0), one = algebra.number(1);
    const NodeId w = algebra.sum(one, ey[1]);
    const Vector v{ey[2], zero, algebra.negative(ey[0])};
    const NodeId square = algebra.sum(algebra.product(w, w), algebra.dot(v, v));
    const NodeId length = algebra.call(Function::sqrt, {square});
    const NodeId is_opposite = algebra.call(Function::less, {square, algebra.number(1e-8)});
    const auto choose = [&](NodeId opposite, NodeId otherwise) {
        return algebra.call(Function::if_, {is_opposite, opposite, otherwise});
    };
    return {choose(zero, algebra.quotient(w, length)),
            {choose(one, algebra.quotient(v[0], length)), zero,
             choose(zero, algebra.quotient(v[2], length))}};
}

/// A vector with a random direction.
NodeId random_vector(FrameAlgebra& algebra, std::uint32_t formula) {
    std::array<NodeId, 3> parts;
    for (std::size_t k = 0; k < 3; ++k) {
        Node draw;
        draw.kind = Call();
        draw.function = Function::normal;
        draw.operands = {algebra.number(0), algebra.number(1)};
        draw.operand_count = 2;
        parts[k] = algebra.add(draw, {formula, NodeId(k)});
    }
    return algebra.call(Function::vector, {parts[0], parts[1], parts[2]}, ValueType::vector);
}

}  // namespace

std::array<Formula, 4> rates_of_frame(ItemId frame, DefinitionId spin) {
    FrameAlgebra algebra;
    const auto item = [&](std::uint32_t k) { return algebra.leaf(ItemId(frame.index() + k)); };
    Node of_spin{spin};
    of_spin.type = ValueType::vector;
    const Turn q{item(0), {item(1), item(2), item(3)}};
    const Turn omega{algebra.number(0), algebra.components(algebra.add(of_spin))};
    const Turn turned = product(algebra, omega, q);
    const NodeId square = algebra.sum(algebra.product(q.w, q.w), algebra.dot(q.v, q.v));
    const NodeId excess = algebra.difference(algebra.number(1), square);
    const auto rate = [&](NodeId part, NodeId of_q) {
        return algebra.sum(algebra.product(algebra.number(0.5), part),
                           algebra.product(excess, of_q));
    };
    return algebra.formulas({rate(turned.w, q.w), rate(turned.v[0], q.v[0]),
                             rate(turned.v[1], q.v[1]), rate(turned.v[2], q.v[2])});
}

std::array<Formula, 4> starting_frame(const Formula& ey, const Formula& ez) {
    FrameAlgebra algebra;
    Flattening flattening(algebra);
    const auto vector = [&](const Formula& formula, auto&& otherwise) {
        return formula.nodes.empty() ? otherwise() : flattening.add(formula);
    };
    const NodeId y = vector(ey, [&] {
        Node normal{CellValue::normal};
        normal.type = ValueType::vector;
        return algebra.add(normal);
    });
    constexpr std::uint32_t of_random_vector = 2;  // Written in neither formula.
    const NodeId z = vector(ez, [&] { return random_vector(algebra, of_random_vector); });

    const Vector up = algebra.components(algebra.call(Function::unit, {y}, ValueType::vector));
    const Vector wanted = algebra.components(z);
    const Turn upright = turn_of_y(algebra, up);
    // Where that turn takes the z axis of space, and the direction across both.
    const auto& [w, v] = upright;
    const NodeId two = algebra.number(2);
    const auto twice = [&](NodeId a, NodeId b) {
        return algebra.product(two, algebra.product(a, b));
    };
    const auto square = [&](NodeId a) { return algebra.product(a, a); };
    const Vector ahead{twice(v[0], v[2]), algebra.negative(twice(w, v[0])),
                       algebra.sum(algebra.difference(square(w), square(v[0])), square(v[2]))};
    const Vector aside = algebra.cross(up, ahead);
    const NodeId angle =
        algebra.call(Function::atan2, {algebra.dot(wanted, aside), algebra.dot(wanted, ahead)});
    const NodeId half = algebra.product(algebra.number(0.5), angle);
    const NodeId cosine = algebra.call(Function::cos, {half});
    const NodeId sine = algebra.call(Function::sin, {half});
    const Turn about{cosine,
                     {algebra.product(sine, up[0]), algebra.product(sine, up[1]),
                      algebra.product(sine, up[2])}};
    const Turn q = product(algebra, about, upright);
    return algebra.formulas({q.w, q.v[0], q.v[1], q.v[2]});
}

}  // namespace cascade::checking
