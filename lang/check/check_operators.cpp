// Operators of derivatives, and the vectors and tensors that some of them take.
//
// In a system of fields a vector is a flux: grad(e), vector(ex, ey), or the result of numbers,
// tensors, + and - applied to vectors. div turns it into a number. In a system of cells it is a
// place or a direction in space; arithmetic is the same.
#include "lang/check/expression_checker.h"

#include <fmt/format.h>

namespace cascade::checking {

TypeWords words_of(ValueType type, bool in_cells) {
    switch (type) {
        case ValueType::number: return {"a number", ""};
        case ValueType::colour: return {"a colour", ""};
        case ValueType::text: return {"a text", ""};
        case ValueType::vector:
            return {"a vector", in_cells ? "dot(a, b) and length(v) make a number of it"
                                         : "div(…) makes a number of it"};
        case ValueType::tensor:
            return {"a tensor", "it multiplies a vector: div(tensor(a1, a2, theta) * grad(e))"};
    }
    return {"", ""};
}

/// Checks arithmetic of vectors. False if no operand is a vector or a tensor.
bool ExpressionChecker::check_vectors(const Node& node) {
    const auto type_of = [&](std::size_t k) { return formula_.nodes[node.operands[k]].type; };
    const auto is_geometric = [](ValueType type) {
        return type == ValueType::vector || type == ValueType::tensor;
    };
    if (info(node.function).kind != FunctionKind::arithmetic) return false;
    const ValueType left = type_of(0);
    if (node.function == Function::negate) {
        if (left != ValueType::vector) return false;
        formula_.nodes.back().type = ValueType::vector;
        parts_.back().turned = parts_[node.operands[0]].turned;
        return true;
    }
    const ValueType right = type_of(1);
    if (!is_geometric(left) && !is_geometric(right)) return false;
    const Span span = node.span;
    const auto words = [&](ValueType type) { return words_of(type, in_cells()).name; };
    bool fits = false;
    std::string message, hint;
    switch (node.function) {
        case Function::multiply:
            fits = (left == ValueType::number && right == ValueType::vector) ||
                   (left == ValueType::vector && right == ValueType::number) ||
                   (left == ValueType::tensor && right == ValueType::vector);
            message = fmt::format("{} cannot be multiplied by {}", words(left), words(right));
            if (left == ValueType::vector && right == ValueType::tensor) {
                hint = "the tensor stands before the vector";
            } else if (in_cells()) {
                hint = "dot(a, b) and cross(a, b) are products of two vectors";
            } else {
                hint = "a number or a tensor can multiply a vector";
            }
            break;
        case Function::divide:
            fits = left == ValueType::vector && right == ValueType::number;
            message = fmt::format("{} cannot be divided by {}", words(left), words(right));
            break;
        default:
            fits = left == ValueType::vector && right == ValueType::vector;
            message = fmt::format("{} and {} cannot be {}", words(left), words(right),
                                  node.function == Function::add ? "added" : "subtracted");
    }
    const bool by_tensor = left == ValueType::tensor;
    const bool is_turned = parts_[node.operands[0]].turned || parts_[node.operands[1]].turned;
    if (fits && by_tensor && is_turned && work_.on_surface) {
        error(span, "on a surface a tensor cannot multiply what a tensor has multiplied",
              "make one tensor of the two");
    } else if (fits) {
        formula_.nodes.back().type = ValueType::vector;
        parts_.back().turned = by_tensor || is_turned;
    } else {
        error(span, std::move(message), std::move(hint));
    }
    return true;
}

void ExpressionChecker::need_vector(NodeId part) {
    const Node& operand = formula_.nodes[part];
    if (operand.type == ValueType::vector || parts_.back().has_error) return;
    error(operand.span, "a vector is needed here", vectors_are);
}

void ExpressionChecker::check_geometry(Node& node) {
    for (const NodeId operand : node.reads()) need_vector(operand);
    const bool is_vector = node.function == Function::cross || node.function == Function::unit;
    if (is_vector) node.type = ValueType::vector;
}

/// Reports the derivative of a constant, which is probably a mistake.
bool ExpressionChecker::is_same_everywhere(NodeId part) {
    if (!parts_[part].constant) return false;
    const Node& node = formula_.nodes.back();
    error(formula_.nodes[part].span,
          fmt::format("{} of a number is 0 everywhere", info(node.function).spelling),
          "it takes something that can differ from cell to cell");
    return true;
}

void ExpressionChecker::check_operator(const Node& node) {
    if (node.function == Function::div) {
        const Node& flux = formula_.nodes[node.operands[0]];
        if (flux.type == ValueType::vector) return;
        return error(flux.span, "div takes a vector",
                     "such as grad(e), d * grad(e) or vector(ex, ey)");
    }
    for (const NodeId operand : node.reads()) need(operand, ValueType::number);
    if (parts_.back().has_error) return;
    switch (node.function) {
        case Function::vector: formula_.nodes.back().type = ValueType::vector; return;
        case Function::tensor: formula_.nodes.back().type = ValueType::tensor; return;
        default: break;
    }
    const bool is_first = node.function == Function::diffuse;
    if (is_same_everywhere(node.operands[is_first ? 0 : node.operand_count - 1u])) return;
    if (node.function == Function::grad) formula_.nodes.back().type = ValueType::vector;
}

}  // namespace cascade::checking
