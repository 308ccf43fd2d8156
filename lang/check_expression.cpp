// One expression: from parts of the syntax tree to parts of a formula, one for one and in order.
#include "lang/check_expression.h"

#include "core/palette.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

namespace cascade::checking {

namespace {

/// What is known of a part besides its node.
struct Part {
    bool faulty = false;  ///< A message has been given; whatever reads it stays silent.
    bool constant = false;
    double value = 0;
};

constexpr std::array<std::string_view, 4> later_functions{"grad", "div", "attr", "integral"};
/// What is taken over something, as in sum(e over i).
constexpr std::array<std::string_view, 3> only_over{"sum", "mean", "product"};

std::string plural(int count) {
    return count == 1 ? std::string("1 value") : fmt::format("{} values", count);
}

/// Texts are looked for among the last few only, so that very many cost no time.
std::uint32_t add_text(Program& program, const std::string& text) {
    const std::size_t count = program.texts.size();
    for (std::size_t i = count; i > 0 && count - i < 64; --i) {
        if (program.texts[i - 1] == text) return static_cast<std::uint32_t>(i - 1);
    }
    program.texts.push_back(text);
    return static_cast<std::uint32_t>(count);
}

std::optional<Function> function_of(std::string_view name) {
    static constexpr auto last = static_cast<std::size_t>(Function::mix);
    for (std::size_t i = 0; i <= last; ++i) {
        const auto function = static_cast<Function>(i);
        const FunctionInfo& row = info(function);
        if (!row.is_operator && row.spelling == name) return function;
    }
    return std::nullopt;
}

Function function_of(ast::UnaryOp op) {
    return op == ast::UnaryOp::negate ? Function::negate : Function::logical_not;
}

Function function_of(ast::BinaryOp op) {
    switch (op) {
        case ast::BinaryOp::logical_or: return Function::logical_or;
        case ast::BinaryOp::logical_and: return Function::logical_and;
        case ast::BinaryOp::less: return Function::less;
        case ast::BinaryOp::less_equal: return Function::less_equal;
        case ast::BinaryOp::greater: return Function::greater;
        case ast::BinaryOp::greater_equal: return Function::greater_equal;
        case ast::BinaryOp::equal: return Function::equal;
        case ast::BinaryOp::not_equal: return Function::not_equal;
        case ast::BinaryOp::add: return Function::add;
        case ast::BinaryOp::subtract: return Function::subtract;
        case ast::BinaryOp::multiply: return Function::multiply;
        case ast::BinaryOp::divide: return Function::divide;
        case ast::BinaryOp::power: return Function::power;
    }
    return Function::add;
}

class ExpressionChecker {
public:
    ExpressionChecker(Workspace& work, const ast::Script& script, ast::Expression expression,
                      const Scope& scope)
        : work_(work), script_(script), expression_(expression), scope_(scope) {}

    std::optional<CheckedExpression> run();

private:
    const ast::Expr& expr(std::uint32_t part) const {
        return script_.expressions[expression_.first + part];
    }
    std::uint32_t part_of(ast::ExprId id) const { return id - expression_.first; }
    void fault(Span span, std::string message, std::string hint = "") {
        work_.diagnostics.error(span, std::move(message), std::move(hint));
        parts_.back().faulty = true;
    }

    void find_text_places();
    void visit(const ast::Number& number);
    void visit(const ast::Text& text);
    void visit(const ast::Name& name);
    void visit(const ast::Bracketed& bracketed);
    void visit(const ast::Qualified& qualified);
    void visit(const ast::RateOf& rate);
    void visit(const ast::Unary& unary);
    void visit(const ast::Binary& binary);
    void visit(const ast::Call& call);
    void visit(const ast::Over& over);
    void visit(const ast::Indexed& indexed);
    void visit(const ast::Garbage&) { parts_.back().faulty = true; }

    void take(std::optional<Node> node);
    void apply(Function function, const std::array<std::uint32_t, 4>& operands, int count);
    void unknown_function(const ast::Word& name);
    bool belongs_here(Function function, Span span);
    void check_types(const Node& node, int count);
    void check_choice(Node& node, std::uint32_t a, std::uint32_t b);
    void check_palette(const Node& node);
    void check_species(const Node& node);
    void need(std::uint32_t part, ValueType type);
    void fold_constants(const Node& node, int count);

    Workspace& work_;
    const ast::Script& script_;
    ast::Expression expression_;
    const Scope& scope_;
    Formula formula_;
    std::vector<Part> parts_;
    std::vector<bool> wants_text_;
};

std::optional<CheckedExpression> ExpressionChecker::run() {
    const std::uint32_t count = expression_.root - expression_.first + 1;
    formula_.nodes.reserve(count);
    parts_.reserve(count);
    find_text_places();
    bool faulty = false;
    for (std::uint32_t part = 0; part < count; ++part) {
        Node node;
        node.span = expr(part).span;
        formula_.nodes.push_back(node);
        parts_.emplace_back();
        std::visit([this](const auto& kind) { visit(kind); }, expr(part).node);
        faulty = faulty || parts_.back().faulty;
    }
    if (faulty) return std::nullopt;
    CheckedExpression checked{std::move(formula_), std::nullopt};
    if (parts_.back().constant) checked.constant = parts_.back().value;
    return checked;
}

/// Palettes and files are named by texts. A bare word in such a place is no unknown name but a text
/// without its quotes. The texts of a call that is wrong itself are not told to be misplaced.
void ExpressionChecker::find_text_places() {
    wants_text_.assign(expression_.root - expression_.first + 1, false);
    for (ast::ExprId id = expression_.first; id <= expression_.root; ++id) {
        const auto* call = std::get_if<ast::Call>(&script_.expressions[id].node);
        if (call == nullptr) continue;
        const auto function = function_of(call->function.text);
        const std::uint32_t end = call->first_argument + call->argument_count;
        if (!function || static_cast<int>(call->argument_count) != info(*function).arity) {
            for (std::uint32_t k = call->first_argument; k < end; ++k) {
                const ast::ExprId argument = script_.arguments[k];
                wants_text_[part_of(argument)] =
                    std::holds_alternative<ast::Text>(script_.expressions[argument].node);
            }
        } else if (function == Function::palette || function == Function::field) {
            wants_text_[part_of(script_.arguments[end - 1])] = true;
        }
    }
}

void ExpressionChecker::visit(const ast::Number& number) {
    formula_.nodes.back().number = number.value;
    parts_.back() = {false, true, number.value};
}

void ExpressionChecker::visit(const ast::Text& text) {
    Node& node = formula_.nodes.back();
    node.kind = NodeKind::text;
    node.type = ValueType::text;
    if (!wants_text_[parts_.size() - 1]) {
        return fault(node.span, "a text can only name a palette or a file",
                     "palette(v, low, high, \"grey\"), field(\"a.npy\")");
    }
    node.index = add_text(work_.program, text.value);
}

void ExpressionChecker::visit(const ast::Name& name) {
    const Span span = formula_.nodes.back().span;
    if (wants_text_[parts_.size() - 1]) {
        return fault(span, "a text in quotes is expected here", fmt::format("\"{}\"", name.name));
    }
    take(resolve_bare(work_, scope_, name.name, span));
}

void ExpressionChecker::visit(const ast::Bracketed& bracketed) {
    take(resolve_bracketed(work_, scope_, bracketed.name, formula_.nodes.back().span));
}

void ExpressionChecker::visit(const ast::Qualified& qualified) {
    take(resolve_qualified(work_, scope_, qualified, formula_.nodes.back().span));
}

void ExpressionChecker::visit(const ast::RateOf& rate) {
    take(resolve_rate(work_, scope_, rate.name, formula_.nodes.back().span));
}

void ExpressionChecker::take(std::optional<Node> node) {
    if (!node) {
        parts_.back().faulty = true;
        return;
    }
    if (node->kind == NodeKind::number) parts_.back() = {false, true, node->number};
    formula_.nodes.back() = *node;
}

void ExpressionChecker::visit(const ast::Unary& unary) {
    apply(function_of(unary.op), {part_of(unary.operand), 0, 0, 0}, 1);
}

void ExpressionChecker::visit(const ast::Binary& binary) {
    apply(function_of(binary.op), {part_of(binary.left), part_of(binary.right), 0, 0}, 2);
}

void ExpressionChecker::visit(const ast::Call& call) {
    const auto function = function_of(call.function.text);
    if (!function) return unknown_function(call.function);
    const FunctionInfo& row = info(*function);
    if (static_cast<int>(call.argument_count) != row.arity) {
        return fault(formula_.nodes.back().span,
                     fmt::format("{} takes {}, not {}", row.spelling, plural(row.arity),
                                 call.argument_count),
                     std::string(row.meaning));
    }
    if (!belongs_here(*function, call.function.span)) return;
    std::array<std::uint32_t, 4> operands{};
    for (std::uint32_t i = 0; i < call.argument_count; ++i) {
        operands[i] = part_of(script_.arguments[call.first_argument + i]);
    }
    apply(*function, operands, static_cast<int>(call.argument_count));
}

/// mean(e over domain). Aggregates over an index have been written out before.
void ExpressionChecker::visit(const ast::Over& over) {
    const auto function = function_of(fmt::format("{} over domain", over.function.text));
    if (!function || over.index.text != "domain") {
        return fault(over.function.span,
                     fmt::format("{} cannot be taken over the domain", over.function.text),
                     "mean, sum, min and max can");
    }
    if (!belongs_here(*function, over.function.span)) return;
    // Until the lowering knows how to make them.
    return fault(over.function.span, "aggregates over the domain are not in this version of the language");
    apply(*function, {part_of(over.operand), 0, 0, 0}, 1);
}

void ExpressionChecker::visit(const ast::Indexed&) {
    fault(formula_.nodes.back().span, "families are not in this version of the language");
}

void ExpressionChecker::unknown_function(const ast::Word& name) {
    if (std::find(later_functions.begin(), later_functions.end(), name.text) !=
        later_functions.end()) {
        return fault(name.span,
                     fmt::format("'{}' is not in this version of the language", name.text));
    }
    if (std::find(only_over.begin(), only_over.end(), name.text) != only_over.end()) {
        return fault(name.span, fmt::format("{} is taken over something", name.text),
                     fmt::format("write {0}(e over i) or {0}(e over domain)", name.text));
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(Function::mix); ++i) {
        const FunctionInfo& row = info(static_cast<Function>(i));
        if (!row.is_operator && !row.is_aggregate) names.emplace_back(row.spelling);
    }
    std::string hint = did_you_mean(work_, name.text, names);
    fault(name.span, fmt::format("there is no function '{}'", name.text), std::move(hint));
}

bool ExpressionChecker::belongs_here(Function function, Span span) {
    const FunctionInfo& row = info(function);
    const Place place = scope_.place;
    const bool at_step = place == Place::rate;
    const bool at_start = place == Place::value;
    const auto refuse = [&](const char* where) {
        fault(span, fmt::format("{} cannot stand here", row.spelling), where);
        return false;
    };
    const bool aggregate = row.is_aggregate;
    const bool varies = aggregate || function == Function::disc || row.places == Places::values ||
                        row.places == Places::noisy || row.places == Places::rates;
    if (place == Place::constant && varies) {
        fault(span, fmt::format("{} must be one number, but {} is {}", scope_.subject,
                                row.spelling,
                                aggregate ? "known only in a run" : "varying by cell"));
        return false;
    }
    if (place == Place::bound && varies) {
        return refuse("a bound is made of numbers and parameters only");
    }
    switch (row.places) {
        case Places::any: return true;
        case Places::rates:
            return at_step || refuse("it belongs in rates and definitions of a system");
        case Places::values: return at_start || refuse("it belongs in values (name: …)");
        case Places::noisy:
            return at_start || at_step || refuse("pictures have no randomness of their own");
        case Places::picture:
            return place == Place::picture || refuse("colours belong in pictures");
    }
    return true;
}

void ExpressionChecker::apply(Function function, const std::array<std::uint32_t, 4>& operands,
                              int count) {
    Node& node = formula_.nodes.back();
    node.kind = NodeKind::call;
    node.function = function;
    node.operands = operands;
    for (int i = 0; i < count; ++i) {
        if (parts_[operands[static_cast<std::size_t>(i)]].faulty) parts_.back().faulty = true;
    }
    if (parts_.back().faulty) return;
    check_types(node, count);
    if (!parts_.back().faulty) fold_constants(node, count);
}

void ExpressionChecker::need(std::uint32_t part, ValueType type) {
    const Node& operand = formula_.nodes[part];
    if (operand.type == type || parts_.back().faulty) return;
    if (type == ValueType::text) {
        return fault(operand.span, "a text in quotes is expected here");
    }
    fault(operand.span, operand.type == ValueType::colour ? "a colour is no number"
                                                          : "a text is no number");
}

void ExpressionChecker::check_types(const Node& node, int count) {
    const auto& operands = node.operands;
    switch (node.function) {
        case Function::if_:
            need(operands[0], ValueType::number);
            return check_choice(formula_.nodes.back(), operands[1], operands[2]);
        case Function::mix:
            need(operands[2], ValueType::number);
            return check_choice(formula_.nodes.back(), operands[0], operands[1]);
        case Function::palette: return check_palette(node);
        case Function::field: return need(operands[0], ValueType::text);
        case Function::lap: return check_species(node);
        default: break;
    }
    for (int i = 0; i < count; ++i) {
        need(operands[static_cast<std::size_t>(i)], ValueType::number);
    }
    if (node.function == Function::rgb) formula_.nodes.back().type = ValueType::colour;
}

void ExpressionChecker::check_choice(Node& node, std::uint32_t a, std::uint32_t b) {
    const ValueType type = formula_.nodes[a].type;
    if (type != formula_.nodes[b].type && !parts_.back().faulty) {
        return fault(formula_.nodes[b].span,
                     fmt::format("{} chooses between two numbers or two colours",
                                 info(node.function).spelling));
    }
    node.type = type;
}

void ExpressionChecker::check_palette(const Node& node) {
    for (std::size_t i = 0; i < 3; ++i) need(node.operands[i], ValueType::number);
    need(node.operands[3], ValueType::text);
    if (parts_.back().faulty) return;
    const Node& text = formula_.nodes[node.operands[3]];
    const std::string& name = work_.program.texts[text.index];
    if (find_palette(name) == nullptr) {
        std::vector<std::string> names;
        for (const Palette& palette : palettes()) names.emplace_back(palette.name);
        std::string hint = did_you_mean(work_, name, names);
        if (hint.empty()) hint = "palettes are " + list_names(names);
        return fault(text.span, fmt::format("there is no palette '{}'", name), std::move(hint));
    }
    formula_.nodes.back().type = ValueType::colour;
}

void ExpressionChecker::check_species(const Node& node) {
    const Node& operand = formula_.nodes[node.operands[0]];
    const System& system = work_.program.systems[scope_.system];
    if (operand.kind == NodeKind::own && system.is_species(operand.index)) return;
    fault(operand.span, fmt::format("{} takes a species", info(node.function).spelling),
          "expressions and parameters come in a later version of the language");
}

void ExpressionChecker::fold_constants(const Node& node, int count) {
    std::array<double, 4> values{};
    bool constant = true;
    for (int i = 0; i < count; ++i) {
        const Part& part = parts_[node.operands[static_cast<std::size_t>(i)]];
        constant = constant && part.constant;
        values[static_cast<std::size_t>(i)] = part.value;
    }
    // Numbers are flushed to zero where a float is denormal, so such a divisor is zero as well.
    if (node.function == Function::divide && parts_[node.operands[1]].constant &&
        std::abs(values[1]) < static_cast<double>(FLT_MIN)) {
        return fault(formula_.nodes[node.operands[1]].span, "division by zero");
    }
    if (!constant) return;
    const auto value = fold(node.function, values[0], values[1], values[2]);
    if (value) parts_.back() = {false, true, *value};
}

}  // namespace

std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression,
                                                  const Scope& scope) {
    return ExpressionChecker(work, script, expression, scope).run();
}

std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope) {
    auto checked = check_expression(work, script, expression, scope);
    if (!checked || checked->type() == ValueType::number) return checked;
    const bool colour = checked->type() == ValueType::colour;
    work.diagnostics.error(checked->formula.nodes.back().span,
                           colour ? "a colour is no number" : "a text is no number");
    return std::nullopt;
}

}  // namespace cascade::checking
