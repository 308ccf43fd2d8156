// Expands expressions with three stacks: a stack of tasks, a stack of functions whose bodies are
// being expanded, and a stack of values for each index. Only for this folder.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/expressions/expand.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/syntax/ast.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cascade::checking {

/// Expands one expression. When a node is finished, its result is pushed on a stack. A result is a
/// node of the new expression.
class Expander {
public:
    Expander(Workspace& work, const ast::Script& script, const Scope& scope)
        : work_(work), scope_(scope) {
        frames_.push_back({&script, nullptr, 0, std::nullopt});
        for (const IndexValue& index : scope.indices) values_[index.name].push_back(index.value);
        // If the system has a parameter called lap, the word `lap` is not the operator.
        has_laplacians_ =
            scope.system == unknown_system || find(work.names[scope.system], "lap") == nullptr;
    }

    Expanded run(ast::ExprId root);

private:
    enum class TaskKind : std::uint8_t {
        visit,   ///< Expand a node and its operands.
        finish,  ///< All operands have been expanded: write the node.
        call,    ///< All arguments have been expanded: expand the body of the function or constant.
        leave,   ///< The body of a function has been expanded: return to the function's call.
        repeat,  ///< Set the index of an aggregate to `value` and expand the aggregate's operand.
        combine,  ///< The aggregate's operand has been expanded for `value`: combine the results.
        apply,    ///< Apply an operator to the result on top of the stack.
        swap,     ///< Exchange the two results on top of the stack.
        scale,    ///< Multiply the two results on top of the stack.
    };
    struct Task {
        TaskKind kind = TaskKind::visit;
        ast::ExprId part = 0;
        /// For an index, its value. For a member, the number of nodes before the nodes of the
        /// member's indices.
        std::int64_t value = 0;
    };
    /// A function whose body is being expanded. The first frame is the expression itself, which is
    /// no function.
    struct Frame {
        const ast::Script* script = nullptr;
        const UserFunction* function = nullptr;
        /// The position of the function's first argument in `arguments_`.
        std::size_t first_argument = 0;
        std::optional<Span> call;  ///< The outermost call that led to this function.
    };

    const ast::Script& script() const { return *frames_.back().script; }
    const ast::Expr& expr(ast::ExprId part) const { return script().expressions[part]; }
    void visit(ast::ExprId part);
    void visit_name(ast::ExprId part, const ast::Name& name);
    void visit_call(ast::ExprId part, const ast::Call& call);
    void visit_over(ast::ExprId part, const ast::Over& over);
    SystemId system_of_names() const;
    void emit_name(Span span, Span word, std::string_view name, std::string_view index);
    void visit_subscripted(Span span, const ast::Name& name);
    void differentiate(Span span, std::string_view axes);
    void emit_length(Span span, const ast::Word& name);
    ast::ExprId append_grown(Span span, ast::ExprId length, int axis);
    void finish(const Task& task);
    void finish_call(const ast::Expr& expr, const ast::Call& call);
    void finish_member(const ast::Expr& expr, const ast::Indexed& member, std::size_t before);
    void enter(ast::ExprId part);
    void apply(ast::ExprId part);
    void repeat(const Task& task);
    void combine(const Task& task);
    /// The script's constant with this name; null if there is none.
    const UserFunction* find_constant(std::string_view name) {
        return functions_of(work_, script()).find_constant(name);
    }
    std::optional<std::int64_t> index_value(ast::ExprId first, ast::ExprId last, Span span);

    ast::ExprId append(Span span, decltype(ast::Expr::node) node);
    void emit(Span span, decltype(ast::Expr::node) node) {
        results_.push_back(append(span, std::move(node)));
    }
    void error(Span span, std::string message, std::string hint) {
        work_.diagnostics.error(span, std::move(message), std::move(hint));
        emit(span, ast::Garbage{});
    }
    ast::ExprId take() {
        const ast::ExprId id = results_.back();
        results_.pop_back();
        return id;
    }
    void push(TaskKind kind, ast::ExprId part, std::int64_t value = 0) {
        tasks_.push_back({kind, part, value});
    }

    Workspace& work_;
    const Scope& scope_;
    Expanded out_;
    std::vector<Task> tasks_;
    std::vector<Frame> frames_;
    std::vector<ast::ExprId> arguments_;  ///< The arguments of the functions in `frames_`.
    /// The nodes of `out_` that are not yet an operand of another node.
    std::vector<ast::ExprId> results_;
    bool has_laplacians_ = true;    ///< Whether `lap` without brackets is the operator.
    std::size_t open_indices_ = 0;  ///< The number of members whose indices are being expanded.
    /// The values that each index has at present. The innermost value is the last. Bodies of
    /// functions cannot read indices.
    std::unordered_map<std::string_view, std::vector<std::int64_t>> values_;
};

}  // namespace cascade::checking
