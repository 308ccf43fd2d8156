// Checks operators of derivatives, and the vectors and tensors that some of them take.
//
// Vectors and tensors have the same arithmetic in all systems: they can be added and multiplied by
// numbers, and a vector can be multiplied by a tensor. In a system of fields, div takes vectors at
// the faces of cells. In a system of crawling cells, vectors are positions and directions in space.
#include "lang/check/expressions/expression_checker.h"
#include "lang/program/stencils.h"
#include "lang/vocabulary/function_groups.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace cascade::checking {

TypeWords words_of(ValueType type, bool in_cells) {
    switch (type) {
        case ValueType::number: return {"a number", ""};
        case ValueType::colour: return {"a colour", ""};
        case ValueType::text: return {"a text", ""};
        case ValueType::vector:
            return {"a vector", in_cells
                                    ? "dot(a, b) and length(v) turn a vector into a number"
                                    : "div(v), dot(v, w), length(v) and v.x turn a vector into a "
                                      "number"};
        case ValueType::tensor:
            return {"a tensor",
                    "multiply it by a vector, as in div(tensor(a1, a2, theta) * "
                    "grad(e))"};
    }
    return {"", ""};
}

namespace {

/// Whether arithmetic has a meaning for these types. Both operands of a sum must have the same
/// type. A vector can be multiplied only by a number or a tensor. Divisors must be numbers.
bool fits(Function function, ValueType left, ValueType right) {
    const bool is_left_number = left == ValueType::number,
               is_right_number = right == ValueType::number;
    switch (info(function).linear) {
        case Linear::each:
            return is_left_number || is_right_number ||
                   (left == ValueType::tensor && right == ValueType::vector);
        case Linear::first: return is_right_number;
        default: return left == right;
    }
}

}  // namespace

/// Checks arithmetic of vectors and tensors. Returns false if no operand is a vector or a tensor.
bool ExpressionChecker::check_vectors(const Node& node) {
    const auto is_geometric = [](ValueType type) {
        return type == ValueType::vector || type == ValueType::tensor;
    };
    if (info(node.function).kind != FunctionKind::arithmetic) return false;
    const NodeId first = node.operands[0], last = node.reads().back();
    const ValueType left = formula_.nodes[first].type, right = formula_.nodes[last].type;
    if (!is_geometric(left) && !is_geometric(right)) return false;
    const bool has_meaning = (is_geometric(left) || left == ValueType::number) &&
                             (node.operand_count == 1 || fits(node.function, left, right));
    const bool by_tensor = left == ValueType::tensor && right == ValueType::vector;
    const bool is_turned = parts_[first].turned || parts_[last].turned;
    if (has_meaning && by_tensor && is_turned && work_.on_surface) {
        error(node.span, "on a surface, only one tensor can multiply a vector",
              "combine the two tensors into one");
    } else if (has_meaning) {
        formula_.nodes.back().type = type_of_result(node.function, std::array{left, right});
        parts_.back().turned = by_tensor || is_turned;
    } else {
        refuse_product(node.function, node.span, left, right);
    }
    return true;
}

void ExpressionChecker::refuse_product(Function function, Span span, ValueType left,
                                       ValueType right) {
    const std::string_view a = words_of(left, in_cells()).name,
                           b = words_of(right, in_cells()).name;
    switch (function) {
        case Function::multiply: {
            const char* hint = "only a number or a tensor can multiply a vector";
            if (left == ValueType::vector && right == ValueType::tensor) {
                hint = "write the tensor before the vector";
            } else if (left == ValueType::vector && right == ValueType::vector) {
                hint = "write dot(a, b) or cross(a, b) for a product of two vectors";
            } else if (in_cells()) {
                hint = "write dot(a, b) or cross(a, b) for a product of two vectors";
            }
            return error(span, fmt::format("{} cannot be multiplied by {}", a, b), hint);
        }
        case Function::divide: return error(span, fmt::format("{} cannot be divided by {}", a, b));
        default:
            return error(span,
                         fmt::format("{} and {} cannot be {}", a, b,
                                     function == Function::add ? "added" : "subtracted"),
                         left == ValueType::tensor || right == ValueType::tensor
                             ? ""
                             : "div(v), dot(v, w), length(v) and v.x are numbers");
    }
}

/// Whether the definition is a vector multiplied by a tensor, or is computed from such a vector.
bool ExpressionChecker::is_turned(DefinitionId definition) const {
    const auto& definitions = work_.program.systems[scope_.system].definitions;
    IdVector<DefinitionId, bool> seen(definitions.size(), false);
    std::vector<DefinitionId> waiting{definition};
    seen[definition] = true;
    while (!waiting.empty()) {
        const Formula& formula = definitions[waiting.back()].formula;
        waiting.pop_back();
        for (const Node& node : formula.nodes) {
            if (node.type != ValueType::vector) continue;
            if (node.calls(Function::multiply) &&
                formula.nodes[node.operands[0]].type == ValueType::tensor) {
                return true;
            }
            const auto* const id = node.as<DefinitionId>();
            if (id == nullptr || seen[*id]) continue;
            seen[*id] = true;
            waiting.push_back(*id);
        }
    }
    return false;
}

void ExpressionChecker::need_vector(NodeId part) {
    const Node& operand = formula_.nodes[part];
    if (operand.type == ValueType::vector || parts_.back().has_error) return;
    error(operand.span, "a vector is needed here", vectors_are(in_cells()));
}

void ExpressionChecker::check_geometry(Node& node) {
    if (node.function == Function::component) {
        const Node& operand = formula_.nodes[node.operands[0]];
        if (operand.type == ValueType::vector) return;
        const std::string_view name = words_of(operand.type, in_cells()).name;
        return error(operand.span, fmt::format("{} has no components", name),
                     "grad(e).x is the first component of a vector");
    }
    for (const NodeId operand : node.reads()) need_vector(operand);
    node.type = type_of_result(node.function, {});
    for (const NodeId operand : node.reads()) {
        if (node.type == ValueType::vector)
            parts_.back().turned = parts_.back().turned || parts_[operand].turned;
    }
}

/// Whether the operand of a derivative is a constant. If so, reports that the derivative is
/// probably a mistake.
bool ExpressionChecker::is_same_everywhere(NodeId part) {
    if (!parts_[part].constant) return false;
    const Node& node = formula_.nodes.back();
    error(formula_.nodes[part].span,
          fmt::format("{} of a number is 0 everywhere", info(node.function).spelling),
          "write a name that differs from cell to cell, such as a species");
    return true;
}

/// Checks advect(v, e) and advect(vx, vy, e).
void ExpressionChecker::check_carrying(const Node& node) {
    const NodeId carried = node.reads().back();
    need(carried, ValueType::number);
    if (node.operand_count == 2) {
        need_vector(node.operands[0]);
    } else {
        for (const NodeId operand : node.reads()) need(operand, ValueType::number);
    }
    if (!parts_.back().has_error) is_same_everywhere(carried);
}

void ExpressionChecker::check_curl(const Node& node) {
    const NodeId of = node.operands[0];
    const bool in_space = work_.program.domain.grid.depth > 1;
    Node& result = formula_.nodes.back();
    if (formula_.nodes[of].type == ValueType::vector) {
        if (in_space) result.type = ValueType::vector;
        return;
    }
    need(of, ValueType::number);
    if (parts_.back().has_error || is_same_everywhere(of)) return;
    if (in_space) {
        return error(formula_.nodes[of].span, "in three dimensions, curl takes a vector",
                     "write curl(vector(0, 0, e)) for the vector (dy(e), -dx(e), 0)");
    }
    result.type = ValueType::vector;
}

/// Checks the shifts i and j, in cells, of shifted(e, i, j).
void ExpressionChecker::check_shift(const Node& node) {
    for (std::size_t k = 1; k < node.operand_count; ++k) {
        const Part& cells = parts_[node.operands[k]];
        const bool is_near = cells.constant && cells.value == std::floor(cells.value) &&
                             std::abs(cells.value) <= farthest_shift;
        if (is_near) {
            // A number with a minus sign is an operator and its operand, so the node is replaced by
            // its constant value.
            formula_.nodes[node.operands[k]] = {cells.value, formula_.nodes[node.operands[k]].span};
            continue;
        }
        return error(formula_.nodes[node.operands[k]].span,
                     fmt::format("'shifted' takes whole numbers of cells, from -{0} to {0}",
                                 farthest_shift),
                     "write columns first, then rows; both must be known before the run");
    }
}

void ExpressionChecker::check_operator(const Node& node) {
    if (node.function == Function::div) {
        const Node& flux = formula_.nodes[node.operands[0]];
        if (flux.type == ValueType::vector) return;
        return error(flux.span, "div takes a vector",
                     "such as grad(e), d * grad(e) or vector(ex, ey)");
    }
    if (node.function == Function::curl) return check_curl(node);
    if (carries(node.function)) return check_carrying(node);
    for (const NodeId operand : node.reads()) need(operand, ValueType::number);
    if (parts_.back().has_error) return;
    if (node.function == Function::symmetric && work_.on_surface && node.operand_count == 6) {
        return error(node.span, "on a surface, a tensor has three entries",
                     "use symmetric(axx, axy, ayy)");
    }
    if (node.function == Function::shifted) return check_shift(node);
    const bool is_derivative = info(node.function).lengths > 0;
    const bool is_first = node.function == Function::diffuse;
    const NodeId of = node.operands[is_first ? 0 : node.operand_count - 1u];
    if (is_derivative && is_same_everywhere(of)) return;
    formula_.nodes.back().type = type_of_result(node.function, {});
}

}  // namespace cascade::checking
