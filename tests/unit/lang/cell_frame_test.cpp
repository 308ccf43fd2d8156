// The frame of a cell: the values of its formulas, compared with rotations of vectors.
#include "lang/check/systems/cell_frame.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace cascade::checking {
namespace {

using Vector = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< w, x, y, z.

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

/// v turned by q: v + 2 w (u × v) + 2 u × (u × v), for a unit q = (w, u).
Vector turned(const Quaternion& q, const Vector& v) {
    const Vector u{q[1], q[2], q[3]};
    const Vector once = cross(u, v), twice = cross(u, once);
    Vector result{};
    for (std::size_t k = 0; k < 3; ++k) result[k] = v[k] + 2 * (q[0] * once[k] + twice[k]);
    return result;
}

/// The value of a formula of numbers and vectors, with given values of items and definitions.
double value_of(const Formula& formula, const Quaternion& items, const Vector& definition) {
    IdVector<NodeId, Vector> values;
    for (const Node& node : formula.nodes) {
        const auto of = [&](std::size_t k) { return values[node.operands[k]]; };
        const auto a = [&] { return of(0)[0]; };
        const auto b = [&] { return of(1)[0]; };
        Vector value{};
        if (const auto* number = node.as<double>()) {
            value[0] = *number;
        } else if (const auto* item = node.as<ItemId>()) {
            value[0] = items[item->index()];
        } else if (node.is<DefinitionId>()) {
            value = definition;
        } else {
            switch (node.function) {
                case Function::add: value[0] = a() + b(); break;
                case Function::subtract: value[0] = a() - b(); break;
                case Function::multiply: value[0] = a() * b(); break;
                case Function::divide: value[0] = a() / b(); break;
                case Function::negate: value[0] = -a(); break;
                case Function::less: value[0] = a() < b() ? 1 : 0; break;
                case Function::if_: value[0] = a() != 0 ? of(1)[0] : of(2)[0]; break;
                case Function::sqrt: value[0] = std::sqrt(a()); break;
                case Function::sin: value[0] = std::sin(a()); break;
                case Function::cos: value[0] = std::cos(a()); break;
                case Function::atan2: value[0] = std::atan2(a(), b()); break;
                case Function::vector: value = {a(), b(), of(2)[0]}; break;
                case Function::unit: value = unit(of(0)); break;
                case Function::component: value[0] = of(0)[static_cast<std::size_t>(b())]; break;
                default: ADD_FAILURE() << "function " << static_cast<int>(node.function);
            }
        }
        values.push_back(value);
    }
    return values.back()[0];
}

Formula constant(const Vector& v) {
    Node call{Call(), {}, ValueType::vector, Function::vector, 3};
    call.operands = {NodeId(0), NodeId(1), NodeId(2)};
    return {{Node{v[0]}, Node{v[1]}, Node{v[2]}, call}};
}

TEST(CellFrame, StartsWithTheAxesThatAreAskedFor) {
    const std::vector<Vector> directions{{1, 0, 0}, {0, 1, 0},       {0, -1, 0},
                                         {0, 0, 1}, {0, 0, -1},      {-2, 0, 0},
                                         {1, 2, 3}, {-0.3, -4, 0.1}, {1e-5, -1, 1e-5},
                                         {0, 3, 4}, {1e-3, -1, 2e-3}};
    for (const Vector& ey : directions) {
        for (const Vector& ez : directions) {
            const auto frame = starting_frame(constant(ey), constant(ez));
            Quaternion q{};
            for (std::size_t k = 0; k < 4; ++k) q[k] = value_of(frame[k], {}, {});
            EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
            const Vector up = unit(ey), y = turned(q, {0, 1, 0}), z = turned(q, {0, 0, 1});
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(y[k], up[k], 2e-4);
            Vector across = ez;
            for (std::size_t k = 0; k < 3; ++k) across[k] -= dot(ez, up) * up[k];
            if (std::sqrt(dot(across, across)) < 1e-2) continue;  // ez is nearly parallel to ey.
            const Vector ahead = unit(across);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(z[k], ahead[k], 2e-4);
        }
    }
}

TEST(CellFrame, TurnsWithItsAngularVelocity) {
    const Vector omega{0.3, -0.7, 1.1};
    Quaternion q{0.5, -0.5, 0.1, 0.7};
    const auto rates = rates_of_frame(ItemId(0), DefinitionId(0));
    const auto rate_of = [&](const Quaternion& at) {
        Quaternion rate{};
        for (std::size_t k = 0; k < 4; ++k) rate[k] = value_of(rates[k], at, omega);
        return rate;
    };
    const auto axes_of = [](const Quaternion& at, const Vector& v) {
        const double length =
            std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2] + at[3] * at[3]);
        return turned({at[0] / length, at[1] / length, at[2] / length, at[3] / length}, v);
    };
    // v' = ω × v for the axes, whatever the length of q.
    const Quaternion rate = rate_of(q);
    constexpr double step = 1e-6;
    Quaternion before = q, after = q;
    for (std::size_t k = 0; k < 4; ++k) {
        before[k] -= step * rate[k];
        after[k] += step * rate[k];
    }
    for (const Vector& axis : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}) {
        const Vector expected = cross(omega, axes_of(q, axis));
        const Vector one = axes_of(before, axis), other = axes_of(after, axis);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR((other[k] - one[k]) / (2 * step), expected[k], 1e-8);
        }
    }
    // The length converges to 1.
    for (int n = 0; n < 2000; ++n) {
        const Quaternion change = rate_of(q);
        for (std::size_t k = 0; k < 4; ++k) q[k] += 0.01 * change[k];
    }
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 0.01);
}

}  // namespace
}  // namespace cascade::checking
