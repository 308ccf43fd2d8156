// Builds expression graphs of formulas with quaternions.
#include "lang/check/systems/cell_frame.h"

#include "lang/calculus/algebra.h"

#include <array>

namespace cascade::checking {

namespace {

using Formulas = std::array<Formula, 4>;

TermVector components(Term vector) {
    const auto part = [&](int k) { return component(vector, vector.number(k)); };
    return {part(0), part(1), part(2)};
}

/// A quaternion.
struct Turn {
    Term w;
    TermVector v;
};

/// The product a b is the rotation b followed by the rotation a.
Turn operator*(const Turn& a, const Turn& b) {
    const TermVector across = cross(a.v, b.v);
    Turn result{a.w * b.w - dot(a.v, b.v), {}};
    for (std::size_t k = 0; k < 3; ++k) result.v[k] = a.w * b.v[k] + b.w * a.v[k] + across[k];
    return result;
}

Formulas formulas(const Algebra& algebra, const Turn& q) {
    return {algebra.formula(q.w), algebra.formula(q.v.x), algebra.formula(q.v.y),
            algebra.formula(q.v.z)};
}

/// The smallest rotation from the y axis of space to the unit vector `ey`. If the two are opposite,
/// it is half a turn about the x axis.
Turn turn_of_y(const TermVector& ey) {
    // The result is the quaternion (1 + y · ey, y × ey), normalised.
    const Term zero = ey.x.number(0), one = ey.x.number(1);
    const Term w = one + ey.y;
    const TermVector v{ey.z, zero, -ey.x};
    const Term square = w * w + dot(v, v), length = sqrt(square);
    const Term is_opposite = square < ey.x.number(1e-8);
    const auto choose = [&](Term opposite, Term otherwise) {
        return if_(is_opposite, opposite, otherwise);
    };
    return {choose(zero, w / length),
            {choose(one, v.x / length), zero, choose(zero, v.z / length)}};
}

/// A vector with a random direction.
Term random_vector(Algebra& algebra, std::uint32_t formula) {
    std::array<Term, 3> parts;
    for (std::size_t k = 0; k < 3; ++k) {
        Node draw;
        draw.kind = Call();
        draw.function = Function::normal;
        draw.operands = {algebra.number(0), algebra.number(1)};
        draw.operand_count = 2;
        parts[k] = {&algebra, algebra.add(draw, {formula, NodeId(k)})};
    }
    return vector(parts[0], parts[1], parts[2]);
}

}  // namespace

Formulas rates_of_frame(ItemId frame, DefinitionId spin) {
    Algebra algebra;
    const auto item = [&](std::uint32_t k) {
        return Term{&algebra, algebra.leaf(ItemId(frame.index() + k))};
    };
    Node of_spin{spin};
    of_spin.type = ValueType::vector;
    const Turn q{item(0), {item(1), item(2), item(3)}};
    const Turn omega{q.w.number(0), components({&algebra, algebra.add(of_spin)})};
    const Turn turned = omega * q;
    const Term square = q.w * q.w + dot(q.v, q.v);
    const Term excess = q.w.number(1) - square;
    const auto rate = [&](Term part, Term of_q) { return part.number(0.5) * part + excess * of_q; };
    return formulas(algebra,
                    {rate(turned.w, q.w),
                     {rate(turned.v.x, q.v.x), rate(turned.v.y, q.v.y), rate(turned.v.z, q.v.z)}});
}

Formulas starting_frame(const Formula& ey, const Formula& ez) {
    Algebra algebra;
    Flattening flattening(algebra);
    const auto vector_of = [&](const Formula& formula, auto&& otherwise) {
        return Term{&algebra, formula.nodes.empty() ? otherwise() : flattening.add(formula)};
    };
    const Term y = vector_of(ey, [&] {
        Node normal{CellValue::normal};
        normal.type = ValueType::vector;
        return algebra.add(normal);
    });
    // A formula index that `ey` and `ez` do not have, so that other random numbers are drawn.
    constexpr std::uint32_t of_random_vector = 2;
    const Term z = vector_of(ez, [&] { return NodeId(random_vector(algebra, of_random_vector)); });

    const TermVector up = components(unit(y)), wanted = components(z);
    const Turn upright = turn_of_y(up);
    // `ahead` is the direction to which `upright` rotates the z axis of space. `aside` is
    // perpendicular to both this direction and ey.
    const auto& [w, v] = upright;
    const Term two = y.number(2);
    const auto twice = [&](Term a, Term b) { return two * (a * b); };
    const TermVector ahead{twice(v.x, v.z), -twice(w, v.x), square(w) - square(v.x) + square(v.z)};
    const TermVector aside = cross(up, ahead);
    const Term along_side = dot(wanted, aside), angle = atan2(along_side, dot(wanted, ahead));
    const Term half = y.number(0.5) * angle, cosine = cos(half), sine = sin(half);
    return formulas(algebra, Turn{cosine, {sine * up.x, sine * up.y, sine * up.z}} * upright);
}

}  // namespace cascade::checking
