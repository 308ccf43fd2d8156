// Expands with an explicit stack of tasks, so that deeply nested calls cannot overflow the stack.
#include "lang/check/expand.h"

#include "core/check.h"
#include "lang/check/check_expression.h"
#include "lang/check/domain_lengths.h"
#include "lang/check/user_functions.h"
#include "lang/syntax/operator_polynomials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::checking {

namespace {

constexpr std::size_t most_parts = 1'000'000;

/// True for the aggregates over an index.
bool is_reduction(std::string_view name) {
    constexpr std::array<std::string_view, 5> names{"sum", "product", "mean", "min", "max"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

class Expander {
public:
    Expander(Workspace& work, const ast::Script& script, const Scope& scope)
        : work_(work), scope_(scope) {
        frames_.push_back({&script, nullptr, 0, std::nullopt});
        for (const IndexValue& index : scope.indices) values_[index.name].push_back(index.value);
        // A system may have a parameter of this name.
        has_laplacians_ =
            scope.system == unknown_system || find(work.names[scope.system], "lap") == nullptr;
    }

    Expanded run(ast::ExprId root);

private:
    enum class TaskKind : std::uint8_t {
        visit,    ///< Expand a node and its operands.
        finish,   ///< The operands are done: write the node itself.
        call,     ///< The arguments are done: go on with the body of the function or constant.
        leave,    ///< The body is done.
        repeat,   ///< An aggregate: bind its index to `value` and expand the operand.
        combine,  ///< The operand is done for `value`.
        apply,    ///< Apply an operator to the last result.
        swap,     ///< Exchange the last two results.
        scale,    ///< Multiply the last two results.
    };
    struct Task {
        TaskKind kind = TaskKind::visit;
        ast::ExprId part = 0;
        std::int64_t value = 0;  ///< Of an index; for members the number of nodes before.
    };
    /// The body of a function that is being expanded; the bottom one is the expression itself.
    struct Frame {
        const ast::Script* script = nullptr;
        const UserFunction* function = nullptr;
        std::size_t first_argument = 0;  ///< In arguments_.
        std::optional<Span> call;        ///< The outermost call.
    };

    const ast::Script& script() const { return *frames_.back().script; }
    const ast::Expr& expr(ast::ExprId part) const { return script().expressions[part]; }
    void visit(ast::ExprId part);
    void visit_name(ast::ExprId part, const ast::Name& name);
    void visit_call(ast::ExprId part, const ast::Call& call);
    void visit_over(ast::ExprId part, const ast::Over& over);
    void emit_length(Span span, const ast::Word& name);
    void finish(const Task& task);
    void finish_call(const ast::Expr& expr, const ast::Call& call);
    void finish_member(const ast::Expr& expr, const ast::Indexed& member, std::size_t before);
    void enter(ast::ExprId part);
    void apply(ast::ExprId part);
    void repeat(const Task& task);
    void combine(const Task& task);
    /// Does the name mean a constant of the script?
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
    std::vector<ast::ExprId> arguments_;  ///< Of the functions in frames_.
    std::vector<ast::ExprId> results_;    ///< Nodes of out_ that are not yet used as operands.
    bool has_laplacians_ = true;          ///< Means `lap` without brackets the operator?
    std::size_t open_indices_ = 0;        ///< Number of members whose index is being expanded.
    /// The values of the indices, the innermost last. Functions cannot read them.
    std::unordered_map<std::string_view, std::vector<std::int64_t>> values_;
};

Expanded Expander::run(ast::ExprId root) {
    const Span span = expr(root).span;
    push(TaskKind::visit, root);
    while (!tasks_.empty()) {
        if (++work_.parts_written > most_parts) {
            out_ = {};
            results_.clear();
            if (work_.parts_written == most_parts + 1) {
                work_.diagnostics.error(
                    span,
                    "this expression is too large when its functions and families are "
                    "written out",
                    fmt::format("a script may grow to {} parts", most_parts));
            }
            frames_.resize(1);
            emit(span, ast::Garbage{});
            break;
        }
        const Task task = tasks_.back();
        tasks_.pop_back();
        switch (task.kind) {
            case TaskKind::visit: visit(task.part); break;
            case TaskKind::finish: finish(task); break;
            case TaskKind::call: enter(task.part); break;
            case TaskKind::leave:
                arguments_.resize(frames_.back().first_argument);
                frames_.pop_back();
                break;
            case TaskKind::repeat: repeat(task); break;
            case TaskKind::combine: combine(task); break;
            case TaskKind::apply: apply(task.part); break;
            case TaskKind::swap: std::swap(results_.back(), results_.end()[-2]); break;
            case TaskKind::scale: {
                const ast::ExprId right = take(), left = take();
                emit(expr(task.part).span, ast::Binary{Function::multiply, left, right});
                break;
            }
        }
    }
    out_.root = take();
    return std::move(out_);
}

ast::ExprId Expander::append(Span span, decltype(ast::Expr::node) node) {
    const auto id = static_cast<ast::ExprId>(out_.parts.expressions.size());
    out_.parts.expressions.push_back({span, std::move(node)});
    out_.calls.push_back(frames_.back().call);
    return id;
}

void Expander::visit(ast::ExprId part) {
    const ast::Expr& here = expr(part);
    if (const auto* length = name_of_length(script(), here)) return emit_length(here.span, *length);
    if (const auto* name = std::get_if<ast::Name>(&here.node)) return visit_name(part, *name);
    if (const auto* call = std::get_if<ast::Call>(&here.node)) return visit_call(part, *call);
    if (const auto* component = std::get_if<ast::Component>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::visit, component->operand);
    }
    if (const auto* over = std::get_if<ast::Over>(&here.node)) return visit_over(part, *over);
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::visit, unary->operand);
    }
    if (const auto* binary = std::get_if<ast::Binary>(&here.node)) {
        const bool is_applied = binary->op == Function::multiply && has_laplacians_ &&
                                applies_operator(script(), binary->left) &&
                                !is_operator(script(), binary->right);
        push(is_applied ? TaskKind::apply : TaskKind::finish, is_applied ? binary->left : part);
        push(TaskKind::visit, binary->right);
        if (!is_applied) push(TaskKind::visit, binary->left);
        return;
    }
    if (const auto* member = std::get_if<ast::Indexed>(&here.node)) {
        ++open_indices_;
        push(TaskKind::finish, part, static_cast<std::int64_t>(out_.parts.expressions.size()));
        if (member->second) push(TaskKind::visit, *member->second);
        return push(TaskKind::visit, member->index);
    }
    emit(here.span, here.node);
}

/// domain.x and the like.
void Expander::emit_length(Span span, const ast::Word& name) {
    const auto length = domain_length(work_, scope_, name);
    if (!length) return emit(span, ast::Garbage{});
    if (length->builtin.empty()) return emit(span, ast::Number{length->factor});
    const ast::ExprId place = append(span, ast::Name{length->builtin});
    const ast::ExprId factor = append(span, ast::Number{length->factor});
    emit(span, ast::Binary{Function::multiply, place, factor});
}

/// A parameter of the function, a constant, an index with a value, or any other name.
void Expander::visit_name(ast::ExprId part, const ast::Name& name) {
    const ast::Expr& here = expr(part);
    const Frame& frame = frames_.back();
    if (frame.function != nullptr) {
        const auto parameter = frame.function->parameters.find(name.name);
        if (parameter != frame.function->parameters.end()) {
            results_.push_back(arguments_[frame.first_argument + parameter->second]);
            return;
        }
    }
    if (const UserFunction* constant = find_constant(name.name)) {
        if (constant->has_error) return emit(here.span, ast::Garbage{});
        return push(TaskKind::call, part);
    }
    if (frame.function != nullptr) return emit(here.span, name);
    const auto values = values_.find(name.name);
    if (values != values_.end() && !values->second.empty()) {
        return emit(here.span, ast::Number{static_cast<double>(values->second.back())});
    }
    // Elsewhere the name may be a parameter of the previous stage.
    if (open_indices_ > 0 && find_index(work_, scope_, name.name) != nullptr) {
        Explanation explanation = index_without_value(name.name);
        return error(here.span, std::move(explanation.message), std::move(explanation.hint));
    }
    emit(here.span, name);
}

void Expander::visit_call(ast::ExprId part, const ast::Call& call) {
    const UserFunction* function = find_function(work_, script(), call.function.text).function;
    if (function != nullptr && function->has_error) return emit(expr(part).span, ast::Garbage{});
    if (function != nullptr && !has_right_count(work_, *function, call, expr(part).span)) {
        return emit(expr(part).span, ast::Garbage{});
    }
    push(function != nullptr ? TaskKind::call : TaskKind::finish, part);
    for (std::uint32_t i = call.argument_count; i > 0; --i) {
        push(TaskKind::visit, script().arguments[call.first_argument + i - 1]);
    }
}

void Expander::enter(ast::ExprId part) {
    const auto* const call = std::get_if<ast::Call>(&expr(part).node);
    const std::size_t count = call != nullptr ? call->argument_count : 0;
    const FoundFunction found =
        call != nullptr
            ? find_function(work_, script(), call->function.text)
            : FoundFunction{find_constant(std::get<ast::Name>(expr(part).node).name), &script()};
    Frame frame{found.script, found.function, arguments_.size(), frames_.back().call};
    if (!frame.call) frame.call = expr(part).span;
    const auto first = results_.end() - static_cast<std::ptrdiff_t>(count);
    arguments_.insert(arguments_.end(), first, results_.end());
    results_.resize(results_.size() - count);
    frames_.push_back(frame);
    push(TaskKind::leave, part);
    push(TaskKind::visit, found.function->body.root);
}

void Expander::visit_over(ast::ExprId part, const ast::Over& over) {
    const bool is_neighbours = over.index.text == "touching" || over.index.text == "near";
    if (over.index.text == "domain" || (is_neighbours && is_of_cells(work_, scope_))) {
        push(TaskKind::finish, part);
        if (over.distance) push(TaskKind::visit, *over.distance);
        return push(TaskKind::visit, over.operand);
    }
    const Index* index = find_index(work_, scope_, over.index.text);
    const auto& invalid = work_.invalid_indices;
    if (index == nullptr &&
        std::find(invalid.begin(), invalid.end(), over.index.text) != invalid.end()) {
        return emit(over.index.span, ast::Garbage{});
    }
    if (index == nullptr) {
        return error(over.index.span, fmt::format("there is no index '{}'", over.index.text),
                     is_neighbours ? "cells that crawl have neighbours; fields have none"
                                   : "an index is declared in a system: i: 1..3");
    }
    if (!is_reduction(over.function.text)) {
        return error(over.function.span,
                     fmt::format("{} cannot be taken over an index", over.function.text),
                     "sum, product, mean, min and max can");
    }
    push(TaskKind::repeat, part, index->low);
}

/// Replaces the last result u by a u, for an operator a (lang/syntax/operator_polynomials.h).
void Expander::apply(ast::ExprId part) {
    const ast::Expr& here = expr(part);
    if (!is_operator(script(), part)) {
        const auto* const number = std::get_if<ast::Number>(&here.node);
        if (number != nullptr && number->value == 1) return;
        push(TaskKind::scale, part);
        push(TaskKind::swap, part);
        return push(TaskKind::visit, part);
    }
    if (std::holds_alternative<ast::Name>(here.node)) {
        const auto first = static_cast<std::uint32_t>(out_.parts.arguments.size());
        out_.parts.arguments.push_back(take());
        return emit(here.span, ast::Call{{here.span, "lap"}, first, 1});
    }
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::apply, unary->operand);
    }
    const auto& binary = std::get<ast::Binary>(here.node);
    switch (binary.op) {
        case Function::multiply:
            push(TaskKind::apply, binary.left);
            return push(TaskKind::apply, binary.right);
        case Function::divide:
            push(TaskKind::finish, part);
            push(TaskKind::visit, binary.right);
            return push(TaskKind::apply, binary.left);
        case Function::power: {
            const auto* const power = std::get_if<ast::Number>(&expr(binary.right).node);
            const bool is_small = power != nullptr && power->value == std::floor(power->value) &&
                                  power->value >= 1 && power->value <= most_operator_power;
            if (!is_small) {
                take();
                return error(expr(binary.right).span,
                             fmt::format("the power of an operator is a number from 1 to {}",
                                         most_operator_power),
                             "as in (1 + lap)^2 u");
            }
            for (int k = 0; k < static_cast<int>(power->value); ++k) {
                push(TaskKind::apply, binary.left);
            }
            return;
        }
        default:  // A sum: u is on the stack twice, and the left side is first.
            results_.push_back(results_.back());
            push(TaskKind::finish, part);
            push(TaskKind::apply, binary.right);
            push(TaskKind::swap, part);
            return push(TaskKind::apply, binary.left);
    }
}

void Expander::repeat(const Task& task) {
    const auto& over = std::get<ast::Over>(expr(task.part).node);
    values_[over.index.text].push_back(task.value);
    push(TaskKind::combine, task.part, task.value);
    push(TaskKind::visit, over.operand);
}

/// ((e1 + e2) + e3) + …, min(min(e1, e2), e3), …
void Expander::combine(const Task& task) {
    const ast::Expr& here = expr(task.part);
    const auto& over = std::get<ast::Over>(here.node);
    const Index* index = find_index(work_, scope_, over.index.text);
    values_[over.index.text].pop_back();
    if (task.value > index->low) {
        const ast::ExprId next = take();
        const ast::ExprId before = take();
        const std::string_view name = over.function.text;
        if (name == "min" || name == "max") {
            auto& arguments = out_.parts.arguments;
            const auto first = static_cast<std::uint32_t>(arguments.size());
            arguments.insert(arguments.end(), {before, next});
            emit(here.span, ast::Call{over.function, first, 2});
        } else {
            const auto op = name == "product" ? Function::multiply : Function::add;
            emit(here.span, ast::Binary{op, before, next});
        }
    }
    if (task.value < index->high) return push(TaskKind::repeat, task.part, task.value + 1);
    if (over.function.text != "mean") return;
    const ast::ExprId sum = take();
    const auto count = static_cast<double>(index->high - index->low + 1);
    const ast::ExprId divisor = append(here.span, ast::Number{count});
    emit(here.span, ast::Binary{Function::divide, sum, divisor});
}

void Expander::finish(const Task& task) {
    const ast::Expr& here = expr(task.part);
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        return emit(here.span, ast::Unary{unary->op, take()});
    }
    if (const auto* binary = std::get_if<ast::Binary>(&here.node)) {
        const ast::ExprId right = take();
        const ast::ExprId left = take();
        return emit(here.span, ast::Binary{binary->op, left, right});
    }
    if (const auto* over = std::get_if<ast::Over>(&here.node)) {
        const auto distance = over->distance ? std::optional(take()) : std::nullopt;
        if (!is_integral(*over)) {
            return emit(here.span, ast::Over{over->function, take(), over->index, distance});
        }
        const ast::Word sum{over->function.span, "sum"};
        const ast::ExprId total = append(here.span, ast::Over{sum, take(), over->index, {}});
        const ast::ExprId content = append(here.span, ast::Number{content_of_cell(work_.program)});
        return emit(here.span, ast::Binary{Function::multiply, total, content});
    }
    if (const auto* call = std::get_if<ast::Call>(&here.node)) return finish_call(here, *call);
    if (const auto* component = std::get_if<ast::Component>(&here.node)) {
        const ast::ExprId vector = take();
        const ast::ExprId number = append(component->name.span, expr(component->axis).node);
        return emit(here.span, ast::Component{vector, number, component->name});
    }
    finish_member(here, std::get<ast::Indexed>(here.node), static_cast<std::size_t>(task.value));
}

void Expander::finish_call(const ast::Expr& here, const ast::Call& call) {
    auto& arguments = out_.parts.arguments;
    const auto first = static_cast<std::uint32_t>(arguments.size());
    arguments.insert(arguments.end(), results_.end() - call.argument_count, results_.end());
    results_.resize(results_.size() - call.argument_count);
    emit(here.span, ast::Call{call.function, first, call.argument_count});
}

/// Folds the nodes of the indices, [before, …), and removes them: only their values are needed.
void Expander::finish_member(const ast::Expr& here, const ast::Indexed& member,
                             std::size_t before) {
    --open_indices_;
    std::vector<ast::ExprId> roots{take()}, parts{member.index};
    if (member.second) {
        roots.insert(roots.begin(), take());
        parts.push_back(*member.second);
    }
    std::vector<std::int64_t> values;
    auto first = static_cast<ast::ExprId>(before);
    for (std::size_t k = 0; k < roots.size(); ++k) {
        const auto value = index_value(first, roots[k], expr(parts[k]).span);
        if (value) values.push_back(*value);
        first = roots[k] + 1;
    }
    out_.parts.expressions.resize(before, {{}, ast::Garbage{}});
    out_.calls.resize(before);
    if (values.size() < roots.size()) return emit(here.span, ast::Garbage{});
    const auto named = [&](std::string_view family) -> std::string_view {
        return out_.names.emplace_back(member_name(family, values));
    };
    const ast::Expr& base = expr(member.base);
    if (const auto* name = std::get_if<ast::Name>(&base.node)) {
        return emit(here.span, ast::Name{named(name->name)});
    }
    if (const auto* own = std::get_if<ast::Bracketed>(&base.node)) {
        return emit(here.span, ast::Bracketed{{here.span, named(own->name.text)}});
    }
    if (const auto* rate = std::get_if<ast::RateOf>(&base.node)) {
        return emit(here.span, ast::RateOf{{here.span, named(rate->name.text)}});
    }
    const auto& other = std::get<ast::Qualified>(base.node);
    emit(here.span, ast::Qualified{other.stage, {here.span, named(other.name.text)}});
}

/// The whole number that the nodes [first, last] evaluate to; reports errors.
std::optional<std::int64_t> Expander::index_value(ast::ExprId first, ast::ExprId last, Span span) {
    Scope constant;
    constant.context = Context::constant;
    constant.subject = "an index";
    const auto checked = check_parts(work_, out_.parts, {first, last}, constant);
    if (!checked) return std::nullopt;
    if (!checked->constant) {
        work_.diagnostics.error(span, "an index must be one number");
        return std::nullopt;
    }
    const double value = *checked->constant;
    if (value == std::floor(value) && std::abs(value) < 1e9) {
        return static_cast<std::int64_t>(value);
    }
    work_.diagnostics.error(span, fmt::format("an index is a whole number, not {}", value));
    return std::nullopt;
}

}  // namespace

const Index* find_index(const Workspace& work, const Scope& scope, std::string_view name) {
    if (scope.context == Context::constant || scope.system == unknown_system) return nullptr;
    for (const Index& index : work.program.systems[scope.system].indices) {
        if (index.name == name) return &index;
    }
    return nullptr;
}

std::string member_name(std::string_view family, const std::vector<std::int64_t>& indices) {
    return fmt::format("{}[{}]", family, fmt::join(indices, ","));
}

bool needs_expansion(Workspace& work, const ast::Script& script, ast::Expression expression,
                     const Scope& scope) {
    const bool has_functions =
        !functions_of(work, script).empty() || work.cell_functions != nullptr;
    for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
        const auto& node = script.expressions[id].node;
        if (std::holds_alternative<ast::Indexed>(node)) return true;
        if (name_of_length(script, script.expressions[id]) != nullptr) return true;
        if (const auto* over = std::get_if<ast::Over>(&node)) {
            if (over->index.text != domain_word || is_integral(*over)) return true;
        } else if (const auto* name = std::get_if<ast::Name>(&node)) {
            const auto is_it = [&](const IndexValue& index) { return index.name == name->name; };
            if (std::ranges::any_of(scope.indices, is_it)) return true;
            if (has_functions && functions_of(work, script).find_constant(name->name)) return true;
            if (name->name == "lap") return true;
        } else if (const auto* call = std::get_if<ast::Call>(&node)) {
            if (has_functions && find_function(work, script, call->function.text)) return true;
        }
    }
    return false;
}

Expanded expand(Workspace& work, const ast::Script& script, ast::Expression expression,
                const Scope& scope) {
    return Expander(work, script, scope).run(expression.root);
}

}  // namespace cascade::checking
