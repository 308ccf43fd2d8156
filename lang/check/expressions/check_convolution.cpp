// Checks the kernels of convolutions: which names they read, and whether they are the same in all
// cells.
//
// A kernel is not a part of the formula that calls convolve, because the kernel is computed for
// lags and not for cells. A kernel is stored in the literals of the program, and the call contains
// the index of the kernel.
#include "lang/check/expressions/check_convolution.h"

#include "lang/check/expressions/expression_checker.h"
#include "lang/program/dependencies.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade::checking {

namespace {

constexpr const char* what_kernels_read =
    "a kernel can contain only numbers, parameters, distance, direction and files";

/// Calls visit(operand) for each operand of a node of the syntax tree.
template <typename Visit>
void for_each_operand(const ast::Script& script, const ast::Expr& expression, const Visit& visit) {
    const auto& node = expression.node;
    if (const auto* unary = std::get_if<ast::Unary>(&node)) visit(unary->operand);
    if (const auto* component = std::get_if<ast::Component>(&node)) visit(component->operand);
    if (const auto* over = std::get_if<ast::Over>(&node)) visit(over->operand);
    if (const auto* binary = std::get_if<ast::Binary>(&node)) {
        visit(binary->left);
        visit(binary->right);
    }
    if (const auto* call = std::get_if<ast::Call>(&node)) {
        for (std::uint32_t k = 0; k < call->argument_count; ++k) {
            visit(script.arguments[call->first_argument + k]);
        }
    }
}

bool may_stand_in_kernel(const Node& node, const System& system, const Literals& literals,
                         bool reads_lags) {
    if (node.is<double>()) return true;
    if (node.is<CellValue>() || node.is<TextId>()) return reads_lags;
    if (const auto* item = node.as<ItemId>()) {
        return *item < system.quantities.next() && !system.is_species(*item);
    }
    if (!node.is<Call>()) return false;
    if (reads_lags && reads_file(node.function)) {
        return node.function != Function::attr &&
               !literals.reading(node.as<Call>()->detail).is_direction;
    }
    return is_elementary(node.function) || info(node.function).kind == FunctionKind::geometry ||
           node.function == Function::vector;
}

}  // namespace

IdVector<NodeId, bool> kernel_parts(const ast::Script& script, ast::Expression expression) {
    IdVector<NodeId, bool> in_kernel(expression.root - expression.first + 1, false);
    std::vector<ast::ExprId> waiting;
    for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
        const auto* const call = std::get_if<ast::Call>(&script.expressions[id].node);
        const bool is_convolution = call != nullptr && call->argument_count > 0 &&
                                    function_named(call->function.text) == Function::convolve;
        if (is_convolution) waiting.push_back(script.arguments[call->first_argument]);
    }
    while (!waiting.empty()) {
        const ast::ExprId id = waiting.back();
        waiting.pop_back();
        if (in_kernel[NodeId(id - expression.first)]) continue;
        in_kernel[NodeId(id - expression.first)] = true;
        for_each_operand(script, script.expressions[id],
                         [&](ast::ExprId operand) { waiting.push_back(operand); });
    }
    return in_kernel;
}

/// Handles the names `distance` and `direction`. Returns false for other names.
bool ExpressionChecker::take_lag(std::string_view name) {
    const auto value = cell_value_named(name);
    if (value != CellValue::distance && value != CellValue::direction) return false;
    Node& node = formula_.nodes.back();
    const bool is_known =
        scope_.system != unknown_system && find(work_.names[scope_.system], name) != nullptr;
    if (is_known) {
        error(node.span,
              fmt::format("'{}' is a name of the system, but it has another meaning in a kernel",
                          name),
              "choose another name in the system");
        return true;
    }
    node.kind = *value;
    node.type = is_vector(*value) ? ValueType::vector : ValueType::number;
    return true;
}

/// Whether the formula can be computed for each lag separately. Reports an error if not.
bool ExpressionChecker::is_kernel(NodeId root, bool reads_lags) {
    static const System none;
    const System& system =
        scope_.system == unknown_system ? none : work_.program.systems[scope_.system];
    for (const Node& node : formula_of(formula_.nodes, root).nodes) {
        if (may_stand_in_kernel(node, system, *work_.program.literals, reads_lags)) continue;
        error(node.span,
              reads_lags ? "this cannot be used in the kernel of a convolution"
                         : "this cannot be used in the reach of a convolution",
              reads_lags ? what_kernels_read : "the reach can contain only numbers and parameters");
        return false;
    }
    return true;
}

/// Checks convolve(k, e) or convolve(k, e, r). In the node, only the operand e remains.
void ExpressionChecker::take_convolution(const ast::Call& call) {
    std::vector<NodeId> parts;
    for (std::uint32_t k = 0; k < call.argument_count; ++k) {
        parts.push_back(part_of(script_.arguments[call.first_argument + k]));
        if (parts_[parts.back()].has_error) parts_.back().has_error = true;
    }
    if (parts_.back().has_error) return;
    for (const NodeId part : parts) need(part, ValueType::number);
    if (parts_.back().has_error || !is_kernel(parts[0], true)) return;
    ConvolutionKernel kernel{formula_of(formula_.nodes, parts[0]), {}};
    if (parts.size() == 3) {
        if (!is_kernel(parts[2], false)) return;
        const Part& reach = parts_[parts[2]];
        if (reach.constant && !(reach.value >= 0 && std::isfinite(reach.value))) {
            return error(formula_.nodes[parts[2]].span,
                         "the reach of a convolution must be at least 0");
        }
        kernel.reach = formula_of(formula_.nodes, parts[2]);
    }
    Node& node = formula_.nodes.back();
    node.kind = Call{work_.program.literals->add(std::move(kernel))};
    node.function = Function::convolve;
    node.operands = {parts[1]};
    node.operand_count = 1;
    has_loose_nodes_ = true;
}

void check_kernels_of_stage(Workspace& work, std::uint32_t index) {
    const Stage& stage = work.program.stages[index];
    const System& system = work.program.system_of(index);
    const IdVector<ItemId, bool> is_late = items_of_aggregates(stage);
    const auto check_kernel = [&](const Formula& kernel) {
        for (const Node& node : kernel.nodes) {
            const auto* const item = node.as<ItemId>();
            if (item == nullptr || (stage.uniform[*item] && !is_late[*item])) continue;
            const std::string name(system.item_name(*item));
            work.diagnostics.error(
                node.span,
                is_late[*item]
                    ? fmt::format("'{}' is not known when the kernel is computed", name)
                    : fmt::format("'{}' differs from cell to cell in stage '{}'", name, stage.name),
                "a kernel must be the same in all cells and known before the stage starts");
        }
    };
    for_each_kernel_of_stage(work.program, index, [&](const ConvolutionKernel& kernel) {
        check_kernel(kernel.weight);
        check_kernel(kernel.reach);
    });
}

}  // namespace cascade::checking
