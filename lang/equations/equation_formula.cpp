// Writes an expression from left to right. A stack contains the pieces that still have to be
// written, so expressions may be of any depth and length.
#include "lang/equations/equation_formula.h"

#include "core/decimal.h"
#include "core/overloaded.h"
#include "core/utf8.h"
#include "lang/equations/equation_marks.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/paper_notation.h"
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/subscripts.h"
#include "lang/vocabulary/units.h"

#include <fmt/core.h>

#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace cascade {

namespace {

constexpr int a_negation = 3, a_comparison = 4, a_sign = 7, a_power = 8, an_atom = 9;

/// An operand to write. It is written in brackets if it binds more loosely than `least`.
struct Operand {
    ast::ExprId id = 0;
    int least = 0;
};
using Piece = std::variant<Operand, std::string>;

class FormulaPrinter {
public:
    FormulaPrinter(const ast::Script& script, const Sources& sources, const Symbols& symbols)
        : script_(script),
          sources_(sources),
          symbols_(symbols),
          tex_(symbols.notation == Notation::tex) {}

    std::string run(ast::ExprId root, int least) {
        stack_.emplace_back(Operand{root, least});
        while (!stack_.empty()) {
            const Piece piece = std::move(stack_.back());
            stack_.pop_back();
            if (const auto* text = std::get_if<std::string>(&piece)) text_ += *text;
            else write(std::get<Operand>(piece));
        }
        return std::move(text_);
    }

private:
    template <typename Node>
    const Node* as(ast::ExprId id) const {
        return std::get_if<Node>(&script_.expressions[id].node);
    }
    std::string both(std::string_view unicode, std::string_view tex) const {
        return std::string(tex_ ? tex : unicode);
    }
    std::span<const ast::ExprId> arguments(const ast::Call& call) const {
        return std::span(script_.arguments).subspan(call.first_argument, call.argument_count);
    }
    void push(std::vector<Piece> pieces) {
        for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
            stack_.push_back(std::move(*piece));
        }
    }
    /// Pushes the pieces of an operator, and brackets around them if `own` binds more loosely than
    /// `least`.
    void push_operator(std::vector<Piece> pieces, int own, int least) {
        // Pushed in reverse order, because the last piece is written first.
        if (own < least) stack_.emplace_back(both(")", "\\right)"));
        push(std::move(pieces));
        if (own < least) stack_.emplace_back(both("(", "\\left("));
    }

    void write(const Operand& operand) {
        const ast::Expr& expression = script_.expressions[operand.id];
        const int least = operand.least;
        std::visit(
            Overloaded{
                [&](const ast::Number& node) {
                    text_ += symbols_.number(digits(expression.span, node.value));
                },
                [&](const ast::Text& node) {
                    text_ +=
                        both("\"" + node.value + "\"", "\\texttt{" + tex_text(node.value) + "}");
                },
                [&](const ast::Name& node) { write_name(node.name, least); },
                [&](const ast::Bracketed& node) { text_ += symbols_.name(node.name.text); },
                [&](const ast::Qualified& node) { text_ += symbols_.name(node.name.text); },
                [&](const ast::RateOf& node) { write_rate(symbols_.name(node.name.text), least); },
                [&](const ast::Unary& node) { write_unary(node, least); },
                [&](const ast::Binary& node) { write_binary(node, least); },
                [&](const ast::Call& node) { write_call(node, least); },
                [&](const ast::Over& node) { write_over(node, least); },
                [&](const ast::Component& node) { write_component(node); },
                [&](const ast::Indexed& node) { write_member(node, least); },
                [](const ast::Garbage&) {},
            },
            expression.node);
    }

    void write_component(const ast::Component& node) {
        const std::string axis(node.name.text);
        const auto* const vector = as<ast::Name>(node.operand);
        if (tex_ && vector) text_ += symbols_.family_in_tex(vector->name) + "_{" + axis + "}";
        else push({Operand{node.operand, an_atom}, both("_" + axis, "_{" + axis + "}")});
    }
    void write_rate(const std::string& symbol, int least) {
        push_operator({both("∂" + symbol + "/∂t", "\\partial_t " + symbol)}, a_power,
                      std::min(least, an_atom));
    }
    void write_member(const ast::Indexed& node, int least) {
        std::string_view family;
        if (const auto* name = as<ast::Name>(node.base)) family = name->name;
        if (const auto* name = as<ast::Bracketed>(node.base)) family = name->name.text;
        if (const auto* name = as<ast::Qualified>(node.base)) family = name->name.text;
        const auto* const rate = as<ast::RateOf>(node.base);
        if (rate) family = rate->name.text;
        const Span indices = join(script_.expressions[node.index].span,
                                  script_.expressions[node.second.value_or(node.index)].span);
        if (const auto parts = derivative_named(family)) {
            const std::string member = symbols_.member(parts->of, sources_.text(indices));
            return write_derivative(parts->axes, member, least);
        }
        if (tex_) {
            std::vector<Piece> pieces = {symbols_.family_in_tex(family) + "_{",
                                         Operand{node.index, anything}};
            if (node.second) {
                pieces.emplace_back(", ");
                pieces.emplace_back(Operand{*node.second, anything});
            }
            pieces.emplace_back("}");
            if (rate) pieces.insert(pieces.begin(), "\\partial_t ");
            return push_operator(std::move(pieces), rate ? a_power : an_atom, least);
        }
        const std::string symbol = symbols_.member(family, sources_.text(indices));
        if (rate) write_rate(symbol, least);
        else text_ += symbol;
    }
    void write_unary(const ast::Unary& node, int least) {
        if (node.op == Function::logical_not) {
            return push_operator({both("not ", "\\lnot "), Operand{node.operand, a_comparison}},
                                 a_negation, least);
        }
        // Brackets separate two signs, which would otherwise be read as one sign.
        push_operator({both("−", "-"), Operand{node.operand, a_power}}, a_sign, least);
    }

    void write_binary(const ast::Binary& node, int least) {
        if (node.op == Function::multiply) return write_product(node, least);
        if (node.op == Function::divide) return write_quotient(node, least);
        if (node.op == Function::power) return write_power(node.left, node.right, least);
        const Infix& infix = *find(infixes, info(node.op).spelling);
        const int own = info(node.op).precedence;
        const int left = is_comparison(node.op) ? own + 1 : own;
        int right = node.op == Function::add ? own : own + 1;
        // To the right of `+` or `−`, an operand that begins with a sign gets brackets.
        if (own == a_sum && as<ast::Unary>(node.right)) right = a_power;
        push_operator({Operand{node.left, left}, both(infix.unicode, infix.tex),
                       Operand{node.right, right}},
                      own, least);
    }
    /// The precedence that a factor needs. A sum over an index needs brackets, because it would
    /// seem to include the factors after it.
    int factor(ast::ExprId id, int least) const {
        const auto* const over = as<ast::Over>(id);
        return over && (over->function.text == "sum" || over->function.text == "product") ? a_sign
                                                                                          : least;
    }
    /// Writes the factors of a product side by side, with a dot between two numbers.
    void write_product(const ast::Binary& node, int least) {
        const auto* const left = as<ast::Binary>(node.left);
        const auto* const right = as<ast::Binary>(node.right);
        const bool right_is_power = right && right->op == Function::power;
        const bool right_is_product = right && right->op == Function::multiply;
        const ast::ExprId first = right_is_power || right_is_product ? right->left : node.right;
        const bool meets_number = as<ast::Number>(first) != nullptr;
        // Unicode has no fraction lines, so `a / b c` would be read as a / (b c).
        const bool left_is_quotient = !tex_ && left && left->op == Function::divide;
        push_operator({Operand{node.left, left_is_quotient ? a_sign : factor(node.left, a_product)},
                       meets_number ? both(" · ", " \\cdot ") : both(" ", " \\, "),
                       Operand{node.right,
                               factor(node.right, right_is_product ? a_product : a_power)}},
                      a_product, least);
    }
    void write_quotient(const ast::Binary& node, int least) {
        if (tex_) {
            // A fraction line makes brackets unnecessary.
            return push_operator({"\\frac{", Operand{node.left, anything}, "}{",
                                  Operand{node.right, anything}, "}"},
                                 a_power, least);
        }
        const bool of_numbers = as<ast::Number>(node.left) && as<ast::Number>(node.right);
        push_operator({Operand{node.left, factor(node.left, a_product)}, of_numbers ? "/" : " / ",
                       Operand{node.right, factor(node.right, a_power)}},
                      a_product, least);
    }
    /// A number as its author wrote it, or its value if the program computed it, as in a table's
    /// function. A computed number may have the source location of a different number.
    std::string digits(Span span, double value) const {
        const std::string_view text = sources_.text(span);
        double written = value;
        const char* const last = text.data() + text.size();
        const auto [end, fault] = from_decimal(text.data(), last, written);
        const bool is_other = fault == std::errc() && end == last && written != value;
        return is_spelling_of_number(text) && !is_other ? std::string(text)
                                                        : fmt::format("{}", value);
    }
    void write_power(ast::ExprId base, ast::ExprId exponent, int least) {
        if (tex_) {
            return push_operator({Operand{base, an_atom}, "^{", Operand{exponent, anything}, "}"},
                                 a_power, least);
        }
        const std::string_view text = sources_.text(script_.expressions[exponent].span);
        const bool is_raised = superscript_digit(decode_utf8(text, 0).value).has_value();
        const auto above = is_raised ? std::string(text) : superscript(text);
        if (above && as<ast::Binary>(exponent) == nullptr) {
            return push_operator({Operand{base, an_atom}, *above}, a_power, least);
        }
        push_operator({Operand{base, an_atom}, "^", Operand{exponent, an_atom}}, a_power, least);
    }

    /// Writes a root. TeX draws the root over its operand.
    void write_root(const std::string& sign, const std::string& tex, ast::ExprId operand,
                    int least) {
        if (tex_) return push({tex + "{", Operand{operand, anything}, "}"});
        push_operator({sign, Operand{operand, an_atom}}, a_power, least);
    }
    void write_call(const ast::Call& call, int least) {
        const std::string_view function = call.function.text;
        const auto operands = arguments(call);
        if (is_unit_call(function)) {
            const std::string unit = symbols_.unit(text_of_unit_call(function));
            return push_operator({Operand{operands[0], an_atom}, unit}, a_product, least);
        }
        if (operands.size() == 1) {
            if (const Around* around = find(arounds, function)) {
                return push({both(around->unicode_open, around->tex_open),
                             Operand{operands[0], anything},
                             both(around->unicode_close, around->tex_close)});
            }
            if (const Prefix* prefix = find(prefixes, function)) {
                return push_operator({both(prefix->unicode, prefix->tex),
                                      Operand{operands[0], an_atom}},
                                     a_power, least);
            }
            if (function == "sqrt") return write_root("√", "\\sqrt", operands[0], least);
            if (function == "cbrt") return write_root("∛", "\\sqrt[3]", operands[0], least);
            if (function == "grad2") {
                return push_operator({both("|∇", "\\left|\\nabla "), Operand{operands[0], an_atom},
                                      both("|²", "\\right|^2")},
                                     a_power, least);
            }
            const auto known = function_named(function);
            if (known && info(*known).kind == FunctionKind::derivative) {
                return write_derivative(function.substr(1), Operand{operands[0], an_atom}, least);
            }
        }
        const Infix* const infix = find(infixes, function);
        if (operands.size() == 2 && infix != nullptr) {
            return push_operator({Operand{operands[0], a_sign}, both(infix->unicode, infix->tex),
                                  Operand{operands[1], a_sign}},
                                 a_product, least);
        }
        if (operands.size() == 2 && function == "pow") {
            return write_power(operands[0], operands[1], least);
        }
        if (operands.size() == 3 && function == "if") return write_choice(operands);
        if (operands.size() >= 2 && (function == "advect" || function == "transport")) {
            return write_advection(operands, least);
        }
        if (operands.size() == 4 && function == "diffuse") {
            return push_operator(
                {both("A(", "\\mathsf{A}\\left("), Operand{operands[1], anything}, ", ",
                 Operand{operands[2], anything}, ", ", Operand{operands[3], anything},
                 both(") : ∇∇", "\\right) : \\nabla\\nabla "), Operand{operands[0], an_atom}},
                a_product, least);
        }
        std::string head = function_symbol(function);
        if (function == "vector") head = "";
        if (function == "tensor" || function == "symmetric") head = both("A", "\\mathsf{A}");
        write_arguments(head, operands);
    }
    std::string function_symbol(std::string_view function) const {
        if (!tex_) return std::string(function);
        if (function == "min" || function == "max") return "\\" + std::string(function);
        return "\\operatorname{" + tex_text(function) + "}";
    }
    /// The operands, separated by commas.
    static std::vector<Piece> listed(std::span<const ast::ExprId> operands) {
        std::vector<Piece> pieces;
        for (const ast::ExprId id : operands) {
            if (!pieces.empty()) pieces.emplace_back(", ");
            pieces.emplace_back(Operand{id, anything});
        }
        return pieces;
    }
    void write_arguments(const std::string& head, std::span<const ast::ExprId> operands) {
        // The pieces that are pushed last are written first.
        push({both(")", "\\right)")});
        push(listed(operands));
        push({head + both("(", "\\left(")});
    }
    void write_choice(std::span<const ast::ExprId> operands) {
        if (tex_) {
            return push({"\\begin{cases}", Operand{operands[1], anything}, " & \\text{if } ",
                         Operand{operands[0], anything}, " \\\\ ", Operand{operands[2], anything},
                         " & \\text{otherwise}\\end{cases}"});
        }
        push({"{", Operand{operands[1], anything}, " if ", Operand{operands[0], anything},
              ", else ", Operand{operands[2], anything}, "}"});
    }
    /// Writes advection: v · ∇e.
    void write_advection(std::span<const ast::ExprId> operands, int least) {
        const Operand advected{operands.back(), an_atom};
        if (operands.size() == 2) {
            const Operand velocity{operands[0], an_atom};
            return push_operator({velocity, both("·∇", " \\cdot \\nabla "), advected}, a_product,
                                 least);
        }
        std::vector<Piece> pieces = listed(operands.first(operands.size() - 1));
        pieces.insert(pieces.begin(), both("(", "\\left("));
        pieces.emplace_back(both(")·∇", "\\right) \\cdot \\nabla "));
        pieces.emplace_back(advected);
        push_operator(std::move(pieces), a_product, least);
    }
    /// Writes a derivative. `axes` is x, xx, xy, …
    void write_derivative(std::string_view axes, const Piece& operand, int least) {
        const auto [before, after] = symbols_.around_derivative(axes);
        push_operator({before, operand, after}, a_power, least);
    }
    /// Writes a name, or the derivative that it means.
    void write_name(std::string_view name, int least) {
        if (const auto parts = derivative_named(name))
            return write_derivative(parts->axes, symbols_.name(parts->of), least);
        text_ += symbols_.name(name);
    }
    std::optional<SubscriptedName> derivative_named(std::string_view name) const {
        return symbols_.declared.contains(name) ? std::nullopt : subscripted_name(name);
    }

    /// Writes an aggregate: sum(e over i), mean(e over domain), …
    void write_over(const ast::Over& node, int least) {
        const std::string_view function = node.function.text;
        const bool of_domain = node.index.text == "domain";
        // Adds the text below the function's name, and then `after`.
        const auto with_under = [&](std::vector<Piece> pieces, std::vector<Piece> after) {
            for (Piece& piece : under(node)) pieces.push_back(std::move(piece));
            for (Piece& piece : after) pieces.push_back(std::move(piece));
            return pieces;
        };
        if (function == "mean") {
            const std::vector<Piece> mean{both("⟨", "\\left\\langle "),
                                          Operand{node.operand, anything},
                                          both("⟩", " \\right\\rangle")};
            return push(of_domain ? mean : with_under(mean, {}));
        }
        if (function == "sum" || function == "product") {
            const bool is_sum = function == "sum";
            return push_operator(with_under({is_sum ? both("Σ", "\\sum") : both("Π", "\\prod")},
                                            {" ", Operand{node.operand, a_product}}),
                                 a_product, least);
        }
        push(with_under({function_symbol(function)},
                        {both("(", "\\left("), Operand{node.operand, anything},
                         both(")", "\\right)")}));
    }
    /// The text below an aggregate's symbol: the domain, the kind of neighbours, or an index.
    std::vector<Piece> under(const ast::Over& node) const {
        const std::string over(node.index.text);
        if (over == "domain") return {both("_Ω", "_{\\Omega}")};
        if (node.distance) {
            return {both("_" + over + "(", "_{\\mathrm{" + over + "}("),
                    Operand{*node.distance, anything}, both(")", ")}")};
        }
        if (over == "touching") return {both("_touching", "_{\\mathrm{touching}}")};
        return {both(subscript(over).value_or("_" + over), "_{" + over + "}")};
    }

    const ast::Script& script_;
    const Sources& sources_;
    const Symbols& symbols_;
    bool tex_;
    std::vector<Piece> stack_;
    std::string text_;
};

}  // namespace

std::string typeset(const ast::Script& script, const Sources& sources, const Symbols& symbols,
                    ast::ExprId root, int least) {
    return FormulaPrinter(script, sources, symbols).run(root, least);
}

}  // namespace cascade
