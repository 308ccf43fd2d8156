// Rewrites a formula node by node. If the value of a node depends on lengths, multiplies it by
// scales, or replaces it by a sum of products with scales.
#include "lang/program/growing_formula.h"

#include "lang/vocabulary/function_groups.h"

#include <utility>

namespace cascade {

namespace {

constexpr std::array second_derivatives{Function::dxx, Function::dyy, Function::dzz};

/// Whether a formula of numbers and t is certainly above 0 for every t ≥ 0.
bool is_above_zero(const Formula& formula) {
    enum Sign { unknown, not_below, above };
    IdVector<NodeId, Sign> signs;
    for (const Node& node : formula.nodes) {
        const auto of = [&](std::size_t n) { return signs[node.operands[n]]; };
        const auto least = [&] { return std::min(of(0), of(1)); };
        const auto* const value = node.as<double>();
        Sign sign = unknown;
        if (value != nullptr) sign = *value > 0 ? above : *value == 0 ? not_below : unknown;
        if (node.is(Builtin::t)) sign = not_below;
        if (node.calls(Function::exp)) sign = above;
        if (node.calls(Function::sqrt)) sign = of(0);
        if (node.calls(Function::multiply)) sign = least();
        if (node.calls(Function::divide) && of(1) == above) sign = of(0);
        if (node.calls(Function::power) && of(0) == above) sign = above;
        if (node.calls(Function::add)) sign = least() == unknown ? unknown : std::max(of(0), of(1));
        signs.push_back(sign);
    }
    return signs.back() == above;
}

}  // namespace

Formula GrowingFormula::rewritten(const Formula& formula) {
    IdVector<NodeId, NodeId> place;
    for (Node node : formula.nodes) {
        for (NodeId& operand : node.reads()) operand = place[operand];
        span_ = node.span;
        place.push_back(node.is<Call>() ? image_of(node) : image_of_leaf(node));
    }
    const bool is_last = place.back().index() + 1 == result_.nodes.size();
    return is_last ? std::move(result_) : formula_of(result_.nodes, place.back());
}

Formula GrowingFormula::diluted(const Formula& rate, ItemId species) {
    span_ = rate.nodes.back().span;
    const NodeId before = copied(rate);
    NodeId dilution = copied(growth_.dilution);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (has_axis(axis)) dilution = sound(dilution, axis);
    }
    const NodeId value = append({species, span_});
    const NodeId loss = product(dilution, value);
    difference(before, loss);
    return std::move(result_);
}

Formula GrowingFormula::at_side(const Formula& value, std::size_t axis, Function by) {
    span_ = value.nodes.back().span;
    const NodeId before = copied(value);
    call(by, {before, scale(axis)});
    return std::move(result_);
}

NodeId GrowingFormula::copied(const Formula& formula) {
    IdVector<NodeId, NodeId> place;
    for (Node node : formula.nodes) {
        for (NodeId& operand : node.reads()) operand = place[operand];
        place.push_back(append(node));
    }
    return place.back();
}

NodeId GrowingFormula::scale(std::size_t axis) {
    if (!scales_[axis]) {
        const NodeId length = copied(growth_.scale[axis]);
        scales_[axis] = sound(length, axis);
    }
    return *scales_[axis];
}

/// Makes the value non-finite when the domain has shrunk to nothing, so that the run ends.
NodeId GrowingFormula::sound(NodeId value, std::size_t axis) {
    if (is_above_zero(growth_.scale[axis])) return value;
    const NodeId zero = number(0), length = copied(growth_.scale[axis]);
    const NodeId is_there = call(Function::less, {zero, length});
    return quotient(value, is_there);
}

/// 1 / scale
NodeId GrowingFormula::inverse(std::size_t axis) {
    if (!inverses_[axis]) {
        const NodeId one = number(1);
        inverses_[axis] = quotient(one, scale(axis));
    }
    return *inverses_[axis];
}

NodeId GrowingFormula::inverse_square(std::size_t axis) {
    if (!squares_[axis]) squares_[axis] = square(inverse(axis));
    return *squares_[axis];
}

/// A number or a vector, divided by the scale of an axis.
NodeId GrowingFormula::shrunk(NodeId value, std::size_t axis) {
    if (!changes(axis)) return value;
    return product(inverse(axis), value);
}

NodeId GrowingFormula::twice_shrunk(NodeId value, std::size_t axis) {
    if (!changes(axis)) return value;
    return product(inverse_square(axis), value);
}

/// Curvatures are the only built-in values that depend on lengths.
NodeId GrowingFormula::image_of_leaf(const Node& node) {
    const NodeId value = append(node);
    if (!is_surface_) return value;
    const auto* const builtin = node.as<Builtin>();
    if (builtin == nullptr) return value;
    switch (*builtin) {
        case Builtin::curvature:
        case Builtin::curvature_mean:
        case Builtin::curvature_high:
        case Builtin::curvature_low: return shrunk(value, main_axis());
        case Builtin::curvature_gauss: return twice_shrunk(value, main_axis());
        default: return value;
    }
}

NodeId GrowingFormula::image_of(const Node& node) {
    if (node.calls(Function::grown)) return times_scale(node);
    // A sum over a surface is an integral.
    if (node.calls(Function::domain_sum) && is_surface_ && changes(main_axis())) {
        const NodeId area = square(scale(main_axis()));
        return product(area, append(node));
    }
    if (node.calls(Function::white)) return white(append(node));
    if (const auto turned = turned_gradient(node)) return *turned;
    const int lengths = info(node.function).lengths;
    if (lengths == 0) return append(node);
    if (!growth_.is_uniform) return by_axes(node);
    const NodeId value = append(node);
    return lengths == 1 ? shrunk(value, main_axis()) : twice_shrunk(value, main_axis());
}

/// On a surface, tensor · (vector / s) becomes (tensor · vector) / s. A tensor times a gradient
/// keeps weights of links that are computed once (lang/lower/model_pass.cpp).
std::optional<NodeId> GrowingFormula::turned_gradient(const Node& node) {
    const auto& known = inverses_[main_axis()];
    if (!is_surface_ || !known || !node.calls(Function::multiply)) return std::nullopt;
    const auto [tensor, vector] = std::array{node.operands[0], node.operands[1]};
    const Node scaled = result_.nodes[vector];
    if (result_.nodes[tensor].type != ValueType::tensor) return std::nullopt;
    if (!scaled.calls(Function::multiply) || scaled.operands[0] != *known) return std::nullopt;
    return product(*known, product(tensor, scaled.operands[1]));
}

NodeId GrowingFormula::times_scale(const Node& node) {
    const auto axis = static_cast<std::size_t>(*result_.nodes[node.operands[1]].as<double>());
    const std::size_t own = axis < 3 ? axis : main_axis();
    if (!changes(own)) return node.operands[0];
    return product(node.operands[0], scale(own));
}

/// Divides white noise by the square root of a cell's content (its length, area or volume).
NodeId GrowingFormula::white(NodeId value) {
    std::optional<NodeId> content;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!has_axis(axis) || !changes(axis)) continue;
        content = content ? product(*content, scale(axis)) : scale(axis);
    }
    if (!content) return value;
    const NodeId root = call(Function::sqrt, {*content});
    return quotient(value, root);
}

NodeId GrowingFormula::sum(const std::vector<NodeId>& terms) {
    if (terms.empty()) return number(0);
    NodeId total = terms.front();
    for (std::size_t n = 1; n < terms.size(); ++n) total = call(Function::add, {total, terms[n]});
    return total;
}

NodeId GrowingFormula::component(NodeId vector, std::size_t axis) {
    const NodeId which = number(static_cast<double>(axis));
    return call(Function::component, {vector, which});
}

/// Divides the components of a vector by the scales of `axes`. The result is a product with a
/// tensor, because this product also has values at faces.
NodeId GrowingFormula::scaled_vector(NodeId vector, const std::array<std::size_t, 3>& axes) {
    const auto entry = [&](std::size_t k) {
        return changes(axes[k]) ? inverse(axes[k]) : number(1);
    };
    const NodeId zero = number(0), x = entry(0), y = entry(1);
    const NodeId tensor = stencil_.z ? call(Function::symmetric, {x, zero, zero, y, zero, entry(2)},
                                            ValueType::tensor)
                                     : call(Function::symmetric, {x, zero, y}, ValueType::tensor);
    return product(tensor, vector);
}

NodeId GrowingFormula::curl(const Node& node) {
    const NodeId of = node.operands[0];
    if (result_.nodes[of].type != ValueType::vector) {
        return scaled_vector(append(node), {1, 0, 2});
    }
    const auto part = [&](std::size_t i, std::size_t j) {
        const auto slope = [&](std::size_t along, std::size_t value) {
            if (!has_axis(along)) return number(0);
            return shrunk(call(first_derivatives[along], {component(of, value)}), along);
        };
        const NodeId first = slope(i, j);
        return difference(first, slope(j, i));
    };
    if (node.type == ValueType::number) return part(0, 1);
    const NodeId x = part(1, 2), y = part(2, 0);
    return call(Function::vector, {x, y, part(0, 1)}, ValueType::vector);
}

/// Rewrites a transport by a velocity. The velocity is a vector or is given by its components.
NodeId GrowingFormula::carried(Node node) {
    if (node.operand_count == 2 && result_.nodes[node.operands[0]].type == ValueType::vector) {
        node.operands[0] = scaled_vector(node.operands[0], {0, 1, 2});
        return append(node);
    }
    for (std::size_t axis = 0; axis + 1 < node.operand_count; ++axis) {
        node.operands[axis] = shrunk(node.operands[axis], axis);
    }
    return append(node);
}

/// Rewrites an operator axis by axis, because the axes have different scales.
NodeId GrowingFormula::by_axes(const Node& node) {
    const NodeId of = node.reads().back();
    if (const Derivative derivative = derivative_of(node.function); derivative.order > 0) {
        const auto first = static_cast<std::size_t>(derivative.first);
        const auto second = static_cast<std::size_t>(derivative.second);
        const NodeId value = append(node);
        if (derivative.order == 1) return shrunk(value, first);
        return first == second ? twice_shrunk(value, first) : shrunk(shrunk(value, first), second);
    }
    if (carries(node.function)) return carried(node);
    switch (node.function) {
        case Function::lap: {
            std::vector<NodeId> terms;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!has_axis(axis)) continue;
                terms.push_back(twice_shrunk(call(second_derivatives[axis], {of}), axis));
            }
            return sum(terms);
        }
        case Function::grad2: {
            std::vector<NodeId> terms;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!has_axis(axis)) continue;
                terms.push_back(square(shrunk(call(first_derivatives[axis], {of}), axis)));
            }
            return sum(terms);
        }
        case Function::grad: return scaled_vector(append(node), {0, 1, 2});
        case Function::curl: return curl(node);
        case Function::div: {
            const NodeId flux = scaled_vector(of, {0, 1, 2});
            return call(Function::div, {flux});
        }
        default: return append(node);  // The checker refuses other operators.
    }
}

}  // namespace cascade
