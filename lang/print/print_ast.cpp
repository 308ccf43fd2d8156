// Prints the syntax tree for `--dump ast`. Blocks and statements are indented. Expressions are in
// prefix form, `(+ a (* 2 b))`, which shows how operators bind.
#include "lang/syntax/parse.h"
#include "lang/vocabulary/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>
#include <vector>

namespace cascade {

namespace {

std::string print_number(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

/// Prints expressions. The stack is explicit, so expressions may be of any depth.
class ExpressionPrinter {
public:
    explicit ExpressionPrinter(const ast::Script& script) : script_(script) {}

    std::string print(ast::ExprId root) {
        text_.clear();
        open(root);
        while (!work_.empty()) {
            Work& work = work_.back();
            if (work.next == work.operands.size()) {
                text_ += ')';
                work_.pop_back();
                continue;
            }
            const ast::ExprId operand = work.operands[work.next++];
            text_ += ' ';
            open(operand);  // This call may make the reference `work` invalid.
        }
        return std::move(text_);
    }

private:
    /// An operator with operands that have not been printed yet.
    struct Work {
        std::vector<ast::ExprId> operands;
        std::size_t next = 0;
    };

    void begin(std::string_view head, std::vector<ast::ExprId> operands) {
        text_ += '(';
        text_ += head;
        work_.push_back({std::move(operands), 0});
    }

    void open(ast::ExprId id) {
        std::visit([this](const auto& node) { print_head(node); }, script_.expressions[id].node);
    }

    void print_head(const ast::Number& node) { text_ += print_number(node.value); }
    void print_head(const ast::Text& node) { text_ += '"' + node.value + '"'; }
    void print_head(const ast::Name& node) { text_ += node.name; }
    void print_head(const ast::Bracketed& node) { text_ += fmt::format("[{}]", node.name.text); }
    void print_head(const ast::Qualified& node) {
        text_ += fmt::format("{}.{}", node.stage.text, node.name.text);
    }
    void print_head(const ast::RateOf& node) { text_ += fmt::format("{}'", node.name.text); }
    void print_head(const ast::Unary& node) { begin(info(node.op).spelling, {node.operand}); }
    void print_head(const ast::Binary& node) {
        begin(info(node.op).spelling, {node.left, node.right});
    }
    void print_head(const ast::Call& node) {
        const auto first = script_.arguments.begin() + node.first_argument;
        const std::string_view name = node.function.text;
        begin(is_unit_call(name) ? fmt::format("unit{}", name) : std::string(name),
              {first, first + node.argument_count});
    }
    void print_head(const ast::Over& node) {
        std::vector<ast::ExprId> operands{node.operand};
        if (node.distance) operands.push_back(*node.distance);
        begin(fmt::format("{} over {}", node.function.text, node.index.text), std::move(operands));
    }
    void print_head(const ast::Indexed& node) {
        std::vector<ast::ExprId> operands{node.base, node.index};
        if (node.second) operands.push_back(*node.second);
        begin("member", std::move(operands));
    }
    void print_head(const ast::Component& node) {
        begin(fmt::format(".{}", node.name.text), {node.operand});
    }
    void print_head(const ast::Garbage&) { text_ += "<unreadable>"; }

    const ast::Script& script_;
    std::string text_;
    std::vector<Work> work_;
};

std::string print_statement(const ast::Statement& statement, ExpressionPrinter& printer) {
    static constexpr std::array<std::string_view, 8> relations = {":",   " =",  "' =", "' +=",
                                                                  " >=", " <=", ":",   " ="};
    std::string result(statement.name.text);
    if (!statement.index.empty()) result += fmt::format("[{}]", statement.index.text);
    if (!statement.side.empty()) result += fmt::format(".{}", statement.side.text);
    result += relations[static_cast<std::size_t>(statement.kind)];
    const char* between = statement.kind == ast::StatementKind::index ? " .. " : ", ";
    for (const ast::Expression& value : statement.values) {
        result += &value == &statement.values.front() ? " " : between;
        result += printer.print(value.root);
    }
    if (statement.range) {
        result += fmt::format(" in {} .. {}", printer.print(statement.range->low.root),
                              printer.print(statement.range->high.root));
        if (statement.range->step) {
            result += fmt::format(" step {}", printer.print(statement.range->step->root));
        }
    }
    if (!statement.after.empty()) result += fmt::format(" after {}", statement.after.text);
    if (!statement.doc.empty()) result += "  ## " + statement.doc;
    return result + "\n";
}

std::string print_function(const ast::FunctionDefinition& function, ExpressionPrinter& printer) {
    const std::string body = printer.print(function.body.root);
    if (function.is_constant) return fmt::format("let {} = {}\n", function.name.text, body);
    std::string result = fmt::format("fn {}(", function.name.text);
    for (const ast::Word& parameter : function.parameters) {
        if (&parameter != &function.parameters.front()) result += ", ";
        result += parameter.text;
    }
    return result + fmt::format(") = {}\n", body);
}

}  // namespace

std::string print_ast(const ast::Script& script, const Sources& sources) {
    std::string result;
    ExpressionPrinter printer(script);
    for (const ast::Use& use : script.uses) result += fmt::format("use \"{}\"\n", use.path);
    for (const ast::FunctionDefinition& function : script.functions) {
        result += print_function(function, printer);
    }
    for (const ast::Block& block : script.blocks) {
        const Span place = block.keyword.span;
        const Location location = sources[place.source].locate(place.begin);
        result += block.keyword.text;
        if (!block.name.empty()) result += fmt::format(" {}", block.name.text);
        if (!block.base.empty()) result += fmt::format(": {}", block.base.text);
        for (const ast::Word& base : block.joined) result += fmt::format(", {}", base.text);
        result += fmt::format("  # line {}\n", location.line);
        for (const ast::Statement& statement : block.sides) {
            result += "    " + print_statement(statement, printer);
        }
        for (const ast::Statement& statement : block.statements) {
            result += "    " + print_statement(statement, printer);
        }
    }
    for (const ast::Statement& option : script.options) {
        result += "option " + print_statement(option, printer);
    }
    for (const ast::Override& change : script.overrides) {
        result += "set ";
        if (!change.stage.empty()) result += fmt::format("{}.", change.stage.text);
        result += print_statement(change.statement, printer);
    }
    return result;
}

}  // namespace cascade
