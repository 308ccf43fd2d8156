// Divides each length of the domain by the length of the grid along the same axis, and finds the
// logarithmic derivative of the result. Lengths are formulas of time.
#include "lang/calculus/growth_of_lengths.h"

#include "lang/calculus/algebra.h"
#include "lang/calculus/derivative_rules.h"
#include "lang/program/calls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cascade {

namespace {

/// Two numbers count as equal if their relative difference is below this number, because the
/// lengths in a script are rounded.
constexpr double same_number = 1e-9;

/// Sums that are nested more deeply than this number are divided as a whole.
constexpr int deepest_sum = 32;

class LengthRules {
public:
    explicit LengthRules(const Formula& length) {
        IdVector<NodeId, NodeId> places;
        for (Node node : length.nodes) {
            for (NodeId& operand : node.reads()) operand = places[operand];
            places.push_back(node.is<Call>() ? algebra_.call_of(node) : algebra_.leaf(node.kind));
        }
        root_ = places.back();
    }

    /// The length divided by a number. Numbers in products and sums are divided, so that
    /// 10 * exp(t) / 10 becomes exp(t).
    Formula divided_by(double divisor) { return algebra_.formula(divided(root_, divisor, 0)); }

    /// The derivative d/dt ln(length); nullopt if there is no rule.
    std::optional<Formula> logarithmic_derivative() {
        if (!derive()) return std::nullopt;
        return algebra_.formula(logarithmic_[root_]);
    }

private:
    NodeId divided(NodeId id, double divisor, int depth) {
        const Node node = algebra_[id];
        if (const auto* const number = node.as<double>()) {
            const double quotient = *number / divisor;
            return algebra_.number(std::abs(quotient - 1) < same_number ? 1 : quotient);
        }
        const auto [a, b] = std::array{node.operands[0], node.operands[1]};
        if (calls(node, is_sum) && depth < deepest_sum) {
            const NodeId first = divided(a, divisor, depth + 1);
            return algebra_.call(node.function, {first, divided(b, divisor, depth + 1)});
        }
        const bool is_product = node.calls(Function::multiply);
        if (is_product && algebra_.is_number(a)) {
            return algebra_.product(divided(a, divisor, depth), b);
        }
        if (is_product && algebra_.is_number(b)) {
            return algebra_.product(a, divided(b, divisor, depth));
        }
        if (is_product && depth < deepest_sum) {
            return algebra_.product(divided(a, divisor, depth + 1), b);
        }
        return algebra_.quotient(id, algebra_.number(divisor));
    }

    bool derive() {
        const std::size_t count = algebra_.size();
        for (const NodeId id : ids_below<NodeId>(count)) {
            const auto slope = slope_of(id);
            if (!slope || algebra_.size() > most_calculus_nodes) return false;
            slopes_.push_back(*slope);
            logarithmic_.push_back(logarithmic_slope_of(id));
        }
        return true;
    }

    std::optional<NodeId> slope_of(NodeId id) {
        const Node node = algebra_[id];
        if (node.is(Builtin::t)) return algebra_.number(1);
        NodeId sum = algebra_.number(0);
        for (std::size_t n = 0; n < node.operand_count; ++n) {
            const NodeId inner = slopes_[node.operands[n]];
            if (algebra_.is_number(inner, 0)) continue;
            const auto partial = partial_derivative(algebra_, node, n);
            if (!partial) return std::nullopt;
            sum = algebra_.sum(sum, algebra_.product(*partial, inner));
        }
        return sum;
    }

    /// Products and powers have simple logarithmic derivatives. For example, the logarithmic
    /// derivative of 10 * exp(r * t) is the number r.
    NodeId logarithmic_slope_of(NodeId id) {
        const Node node = algebra_[id];
        const auto [a, b] = std::array{node.operands[0], node.operands[1]};
        if (node.calls(Function::multiply)) return algebra_.sum(logarithmic_[a], logarithmic_[b]);
        if (node.calls(Function::divide))
            return algebra_.difference(logarithmic_[a], logarithmic_[b]);
        if (node.calls(Function::exp)) return slopes_[a];
        if (calls(node, is_power) && algebra_.is_number(b))
            return algebra_.product(b, logarithmic_[a]);
        if (algebra_.is_number(slopes_[id], 0)) return slopes_[id];
        return algebra_.quotient(slopes_[id], id);
    }

    Algebra algebra_;
    NodeId root_;
    IdVector<NodeId, NodeId> slopes_, logarithmic_;
};

bool are_same(const Node& a, const Node& b) {
    const auto *first = a.as<double>(), *second = b.as<double>();
    if (first != nullptr && second != nullptr) {
        return std::abs(*first - *second) <= same_number * std::abs(*first);
    }
    return a.is(b.kind) && a.function == b.function && std::ranges::equal(a.reads(), b.reads());
}

Formula sum_of(const std::vector<Formula>& terms) {
    Algebra algebra;
    NodeId sum = algebra.number(0);
    for (const Formula& term : terms) {
        IdVector<NodeId, NodeId> places;
        for (Node node : term.nodes) {
            for (NodeId& operand : node.reads()) operand = places[operand];
            places.push_back(algebra.add(node));
        }
        sum = algebra.sum(sum, places.back());
    }
    return algebra.formula(sum);
}

}  // namespace

std::optional<Growth> growth_of(std::span<const Formula> lengths, const Grid& grid) {
    const std::array cells{grid.width, grid.height, grid.depth};
    Growth growth;
    std::vector<Formula> rates;
    std::optional<std::size_t> first;  // The first axis with more than one cell.
    for (std::size_t axis = 0; axis < cells.size(); ++axis) {
        growth.scale[axis] = {{Node{1.0}}};
        if (cells[axis] == 1) continue;
        const std::size_t given = axis < lengths.size() ? axis : 0;
        LengthRules rules(lengths[given]);
        growth.scale[axis] = rules.divided_by(static_cast<double>(cells[given]) * grid.spacing);
        auto rate = rules.logarithmic_derivative();
        if (!rate) return std::nullopt;
        rates.push_back(std::move(*rate));
        if (!first) first = axis;
        growth.is_uniform &=
            std::ranges::equal(growth.scale[*first].nodes, growth.scale[axis].nodes, are_same);
    }
    growth.dilution = sum_of(rates);
    return growth;
}

std::optional<Growth> growth_of_surface(const Formula& extent, double start) {
    LengthRules rules(extent);
    Growth growth;
    const Formula scale = rules.divided_by(start);
    growth.scale = {scale, scale, {{Node{1.0}}}};
    const auto rate = rules.logarithmic_derivative();
    if (!rate) return std::nullopt;
    growth.dilution = sum_of({*rate, *rate});
    return growth;
}

}  // namespace cascade
