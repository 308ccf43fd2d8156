// Sorts the statements of a system by kind (rates, definitions, bounds, starting values,
// parameters), and prints one kind after another.
#include "lang/equations/equations.h"

#include "lang/library/system_statements.h"
#include "lang/equations/equation_formula.h"
#include "lang/equations/equation_lines.h"
#include "lang/equations/mathml.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

namespace cascade {

namespace {

// Finds which definitions of a system are vectors. Uses only the syntax tree, because scripts are
// printed without a check (internal to printing equations).

using Names = std::set<std::string, std::less<>>;

/// Whether the value of the expression is a vector. `names` are the names whose values are vectors.
bool is_vector(const ast::Script& script, ast::Expression expression, const Names& names) {
    std::vector<bool> known(expression.root - expression.first + 1, false);
    const auto of = [&](ast::ExprId id) { return bool(known[id - expression.first]); };
    for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
        const auto& node = script.expressions[id].node;
        bool is = false;
        if (const auto* name = std::get_if<ast::Name>(&node)) is = names.contains(name->name);
        if (const auto* member = std::get_if<ast::Indexed>(&node)) is = of(member->base);
        if (const auto* unary = std::get_if<ast::Unary>(&node)) is = of(unary->operand);
        if (const auto* binary = std::get_if<ast::Binary>(&node)) {
            const bool is_arithmetic = info(binary->op).kind == FunctionKind::arithmetic;
            is = is_arithmetic && (of(binary->left) || of(binary->right));
        }
        if (const auto* call = std::get_if<ast::Call>(&node); call && call->argument_count > 0) {
            const auto function = function_named(call->function.text);
            const ast::ExprId last =
                script.arguments[call->first_argument + call->argument_count - 1];
            const ast::ExprId first = script.arguments[call->first_argument];
            const auto result = function ? info(*function).result : ResultKind::number;
            is = result == ResultKind::vector ||
                 (result == ResultKind::like && (of(first) || of(last))) ||
                 (function == Function::curl && !of(first));
        }
        known[id - expression.first] = is;
    }
    return known.back();
}

/// The names of definitions, and of families of definitions, that are computed from gradients and
/// other vectors.
Names vector_names(const SystemStatements& system) {
    Names names;
    for (bool grows = true; grows;) {
        grows = false;
        for (const SaidStatement& said : system.all()) {
            const ast::Statement& statement = *said.statement;
            if (statement.kind != ast::StatementKind::definition) continue;
            if (names.contains(statement.name.text)) continue;
            if (!is_vector(*said.script, statement.values.front(), names)) continue;
            names.emplace(statement.name.text);
            grows = true;
        }
    }
    return names;
}

/// One line of the printed equations, such as ∂u/∂t = f.
struct Line {
    std::string left, relation, right;
};

class EquationPrinter {
public:
    EquationPrinter(const SystemStatements& system, Notation notation, std::string_view name)
        : system_(system), name_(name) {
        symbols_.notation = notation;
        for (const SaidStatement& said : system.all()) {
            symbols_.subscripts = symbols_.subscripts && (is_setting(*said.statement) ||
                                                          has_subscript(said.statement->name.text));
        }
        for (const SaidStatement& said : system.all()) {
            symbols_.declared.emplace(said.statement->name.text);
            for (const ast::FunctionDefinition& function : said.script->functions) {
                symbols_.declared.emplace(function.name.text);
                for (const ast::Word& each : function.parameters)
                    symbols_.declared.emplace(each.text);
            }
        }
        if (!system.is_cells()) symbols_.vectors = vector_names(system);
        for (const SaidStatement& said : system.all()) sort(said);
        add_functions();
    }

    std::string run(EquationParts parts) const {
        const bool all = parts == EquationParts::all;
        return symbols_.notation == Notation::tex ? run_tex(all) : run_unicode(all);
    }

    /// The MathML of one name's equation, converted from TeX.
    std::string mathml(std::string_view name) const {
        const Line* const line = line_of(name);
        return line != nullptr ? mathml(*line) : "";
    }
    /// The equation of one name as a line of text.
    std::string unicode(std::string_view name) const {
        const Line* const line = line_of(name);
        if (line == nullptr) return "";
        return fmt::format("{} {} {}", line->left, line->relation, line->right);
    }

private:
    static bool is_setting(const ast::Statement& statement) {
        return statement.kind == ast::StatementKind::value && statement.index.empty() &&
               reserved(statement.name.text) != Reserved::no;
    }
    bool is_tex() const { return symbols_.notation == Notation::tex; }
    /// The line with the rate, definition or value of a name. Null if the system has none.
    const Line* line_of(std::string_view name) const {
        const std::string symbol = symbols_.name(name);
        for (const auto* lines : {&rates_, &definitions_, &parameters_}) {
            for (const Line& line : *lines) {
                if (line.left == symbol || line.left == rate_of(symbol)) return &line;
            }
        }
        return nullptr;
    }
    std::string typeset_value(const SaidStatement& said, const ast::Expression& value,
                              int least = anything) const {
        return typeset(*said.script, *said.sources, symbols_, value.root, least);
    }

    void sort(const SaidStatement& said) {
        const ast::Statement& statement = *said.statement;
        const ast::Expression& first = statement.values.front();
        const bool is_text =
            std::holds_alternative<ast::Text>(said.script->expressions[first.root].node);
        if (is_setting(statement) || is_text) return;
        const std::string symbol = statement.index.empty()
                                       ? symbols_.name(statement.name.text)
                                       : symbols_.member(statement.name.text, statement.index.text);
        if (system_.is_cells() && take_of_cells(said, symbol)) return;
        switch (statement.kind) {
            case ast::StatementKind::rate:
            case ast::StatementKind::rate_term: return add_rate(said, symbol);
            case ast::StatementKind::definition:
                definitions_.push_back({symbol, "=", typeset_value(said, first)});
                return;
            case ast::StatementKind::at_least:
                bounds_.push_back({symbol, is_tex() ? "\\ge" : "≥", typeset_value(said, first)});
                return;
            case ast::StatementKind::at_most:
                bounds_.push_back({symbol, is_tex() ? "\\le" : "≤", typeset_value(said, first)});
                return;
            case ast::StatementKind::index:
                indices_.push_back({symbol, "=",
                                    typeset_value(said, first) + (is_tex() ? ", \\dots, " : " … ") +
                                        typeset_value(said, statement.values.back())});
                return;
            case ast::StatementKind::constraint:
                definitions_.push_back({"0", "=", typeset_value(said, first)});
                return;
            case ast::StatementKind::value: break;
        }
        std::string value = typeset_value(said, first);
        for (std::size_t k = 1; k < statement.values.size(); ++k) {
            value += ", " + typeset_value(said, statement.values[k]);
        }
        (system_.is_species(statement.name.text) ? starts_ : parameters_)
            .push_back({symbol, "=", std::move(value)});
    }

    std::string rate_of(const std::string& symbol) const {
        // The rate of the frame is printed as an angular velocity.
        if (system_.is_cells() && symbol == symbols_.name("turn"))
            return is_tex() ? "\\omega" : "ω";
        return is_tex() ? "\\partial_t " + symbol : "∂" + symbol + "/∂t";
    }

    /// Handles statements that only cells have: divide, die, reach, and values that restart after a
    /// division. Returns false for other statements.
    bool take_of_cells(const SaidStatement& said, const std::string& symbol) {
        const ast::Statement& statement = *said.statement;
        if (statement.kind != ast::StatementKind::value) return false;
        const std::string_view name = statement.name.text;
        std::string value = typeset_value(said, statement.values.front());
        if (name == "divide" || name == "die") {
            const std::string word = name == "divide" ? "divides" : "dies";
            events_.push_back({is_tex() ? fmt::format("\\text{{{}}}", word) : word,
                               is_tex() ? "\\text{ if }" : "if", std::move(value)});
            return true;
        }
        if (name == "along" || name == "reach") return true;
        if (!statement.after.empty()) restarts_.push_back({symbol, "=", std::move(value)});
        const bool is_start = std::ranges::any_of(system_.all(), [&](const SaidStatement& each) {
            return each.statement->kind == statement.kind && each.statement->after.empty() &&
                   each.statement->name.text == name;
        });
        return !statement.after.empty() && is_start;
    }

    /// Adds a term to a rate. All terms of a rate become one sum, even if other statements are
    /// between them.
    void add_rate(const SaidStatement& said, const std::string& symbol) {
        const ast::Statement& statement = *said.statement;
        const auto& value = statement.values.front();
        const auto [place, is_new] = rate_lines_.try_emplace(symbol, rates_.size());
        if (is_new) {
            rates_.push_back({rate_of(symbol), "=", typeset_value(said, value)});
            return;
        }
        std::string& sum = rates_[place->second].right;
        const std::string term = typeset_value(said, value, a_sum);
        const std::string_view sign = is_tex() ? "-" : "−";
        const bool is_negative = term.starts_with(sign);
        sum += is_negative ? fmt::format(" {} ", sign) : " + ";
        sum += is_negative ? term.substr(sign.size()) : term;
    }

    /// Adds those functions and constants of the script that the system reads, each once, in the
    /// order of their first use.
    void add_functions() {
        for (const SaidStatement& said : system_.all()) {
            for (const ast::Expression& value : said.statement->values) note_calls(said, value);
        }
        for (std::size_t k = 0; k < called_.size(); ++k) {  // `called_` grows inside the loop.
            const auto [said, function] = called_[k];
            definitions_.push_back({call_of(*function), "=", typeset_value(said, function->body)});
            note_calls(said, function->body);
        }
    }
    std::string call_of(const ast::FunctionDefinition& function) const {
        if (function.is_constant) return symbols_.name(function.name.text);
        std::string symbol = function_symbol(function.name.text) + "(";
        for (const ast::Word& parameter : function.parameters) {
            if (&parameter != &function.parameters.front()) symbol += ", ";
            symbol += symbols_.name(parameter.text);
        }
        return symbol + ")";
    }
    void note_calls(const SaidStatement& said, const ast::Expression& expression) {
        if (said.script->functions.empty()) return;
        for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
            const auto& node = said.script->expressions[id].node;
            const auto* const call = std::get_if<ast::Call>(&node);
            const auto* const constant = std::get_if<ast::Name>(&node);
            if (call == nullptr && constant == nullptr) continue;
            const std::string_view read = call != nullptr ? call->function.text : constant->name;
            for (const ast::FunctionDefinition& function : said.script->functions) {
                if (function.name.text != read || function.is_constant != (constant != nullptr))
                    continue;
                if (called_names_.insert(read).second) called_.push_back({said, &function});
            }
        }
    }
    std::string function_symbol(std::string_view name) const {
        return is_tex() ? fmt::format("\\operatorname{{{}}}", tex_text(name)) : std::string(name);
    }

    std::string run_unicode(bool all) const {
        std::string text;
        const auto list = [&](std::string_view head, const std::vector<Line>& lines) {
            for (const Line& line : lines) {
                text += fmt::format("  {:<9}{} {} {}\n", &line == &lines.front() ? head : "",
                                    line.left, line.relation, line.right);
            }
        };
        for (const Line& line : rates_) {
            text += fmt::format("  {} {} {}\n", line.left, line.relation, line.right);
        }
        list("for", indices_);
        list("where", definitions_);
        list("always", bounds_);
        list("a cell", events_);
        list("divided", restarts_);
        if (all) list("with", parameters_);
        if (all) list("at first", starts_);
        return text;
    }

    std::string run_tex(bool all) const {
        std::string text = fmt::format("% {}; needs \\usepackage{{amsmath}}\n", name_);
        align(text, "align", rates_);
        if (!indices_.empty()) text += "for " + inline_list(indices_) + "\n";
        if (!definitions_.empty()) text += "where\n";
        align(text, "align*", definitions_);
        if (!bounds_.empty()) text += "Always " + inline_list(bounds_) + ".\n";
        if (!events_.empty()) text += "A cell " + inline_list(events_) + ".\n";
        if (!restarts_.empty()) text += "After a division " + inline_list(restarts_) + ".\n";
        if (all && !parameters_.empty()) text += "With " + inline_list(parameters_) + ".\n";
        if (all && !starts_.empty()) text += "At first " + inline_list(starts_) + ".\n";
        return text;
    }
    static void align(std::string& text, std::string_view environment,
                      const std::vector<Line>& lines) {
        if (lines.empty()) return;
        text += fmt::format("\\begin{{{}}}\n", environment);
        for (const Line& line : lines) {
            const std::vector<std::string> pieces = broken_sum(line.right);
            text += fmt::format("  {} &{} {}", line.left, line.relation, pieces.front());
            for (std::size_t k = 1; k < pieces.size(); ++k) {
                text += fmt::format(" \\notag \\\\\n  &\\quad {{}} {}", pieces[k]);
            }
            text += &line == &lines.back() ? "\n" : " \\\\\n";
        }
        text += fmt::format("\\end{{{}}}\n", environment);
    }
    /// The rows of an equation in MathML. A sum that is too long for a line gets a row for each
    /// part.
    static std::string mathml(const Line& line) {
        std::string rows, left = line.left + " " + line.relation;
        for (const std::string& piece : broken_sum(line.right)) {
            rows += fmt::format("<mtr><mtd>{}</mtd><mtd>{}</mtd></mtr>", mathml_of(left),
                                mathml_of(piece));
            left.clear();
        }
        return fmt::format("<math><mtable>{}</mtable></math>", rows);
    }
    static std::string inline_list(const std::vector<Line>& lines) {
        std::string text;
        for (const Line& line : lines) {
            text += fmt::format("{}${} {} {}$", text.empty() ? "" : ",\n  ", line.left,
                                line.relation, line.right);
        }
        return text;
    }

    const SystemStatements& system_;
    std::string_view name_;
    Symbols symbols_;
    /// For each species, the index of the line with its rate.
    std::unordered_map<std::string, std::size_t> rate_lines_;
    std::vector<std::pair<SaidStatement, const ast::FunctionDefinition*>> called_;
    std::unordered_set<std::string_view> called_names_;
    std::vector<Line> rates_, indices_, definitions_, bounds_, parameters_, starts_;
    std::vector<Line> events_, restarts_;  ///< The lines that only crawling cells have.
};

}  // namespace

std::vector<std::string> print_equations(const ast::Script& script, const Sources& sources,
                                         std::span<const std::string_view> systems,
                                         Notation notation, EquationParts parts) {
    const SystemBlocks blocks = system_blocks(script);
    std::vector<std::string> texts;
    for (const std::string_view system : systems) {
        const SystemStatements statements(script, sources, blocks, system);
        texts.push_back(
            statements.found() ? EquationPrinter(statements, notation, system).run(parts) : "");
    }
    return texts;
}

std::string print_equations(const ast::Script& script, const Sources& sources,
                            std::string_view system, Notation notation, EquationParts parts) {
    return print_equations(script, sources, std::span(&system, 1), notation, parts).front();
}

std::string equation_in_mathml(const ast::Script& script, const Sources& sources,
                               std::string_view system, std::string_view name) {
    const SystemBlocks blocks = system_blocks(script);
    const SystemStatements statements(script, sources, blocks, system);
    if (!statements.found()) return "";
    return EquationPrinter(statements, Notation::tex, system).mathml(name);
}

std::string equation_in_unicode(const ast::Script& script, const Sources& sources,
                                std::string_view system, std::string_view name) {
    const SystemBlocks blocks = system_blocks(script);
    const SystemStatements statements(script, sources, blocks, system);
    if (!statements.found()) return "";
    return EquationPrinter(statements, Notation::unicode, system).unicode(name);
}

}  // namespace cascade
