// Options with a special syntax, such as --grid 64x32 and --mesh horse.ply, become nodes of the
// syntax tree without being parsed as expressions. The values of all other options are parsed as
// expressions.
#include "run/script/option_statements.h"

#include "lang/program/models.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace cascade {

namespace {

class OptionStatements {
public:
    explicit OptionStatements(Script& script) : script_(script) {}

    /// Adds the statement `name: text` for the option `--name text`.
    void add(std::string_view name, const std::string& text) {
        ast::Statement& statement = begin(name, text);
        const auto value = parse_expression(statement.span.source, script_.sources, script_.tree,
                                            script_.diagnostics);
        if (!value) return script_.tree.options.pop_back();
        statement.values.push_back(*value);
    }

    /// Adds a statement that has no value.
    void add(std::string_view name) { begin(name, ""); }

    void add_grid(const GridSize& size, bool is_one_number) {
        std::vector<std::int64_t> sides{size.width};
        if (!is_one_number) sides.push_back(size.height);
        if (size.depth != 1) sides.push_back(size.depth);
        ast::Statement& statement = begin("grid", fmt::format("{}", fmt::join(sides, "x")));
        Span span = statement.span;
        for (const std::int64_t side : sides) {
            span.end = span.begin + static_cast<std::uint32_t>(std::to_string(side).size());
            give(statement, span, ast::Number{static_cast<double>(side)});
            span.begin = span.end + 1;
        }
    }

    /// Adds a model: the built-in shape of that name or, if there is none, a file.
    void add_model(const std::string& model) {
        ast::Statement& statement = begin("mesh", model);
        const Span span = statement.span;
        if (!shape_named(model)) return give(statement, span, ast::Text{model});
        statement.name.text = "surface";
        give(statement, span, ast::Name{script_.sources.text(span)});
    }

private:
    ast::Statement& begin(std::string_view name, const std::string& text) {
        ast::Statement& statement = script_.tree.options.emplace_back();
        statement.span = option_span(script_.sources, fmt::format("--{}", name), text);
        statement.name = {statement.span, name};
        return statement;
    }

    void give(ast::Statement& statement, Span span, decltype(ast::Expr::node) value) {
        const auto id = static_cast<ast::ExprId>(script_.tree.expressions.size());
        script_.tree.expressions.push_back({span, std::move(value)});
        statement.values.push_back({id, id});
    }

    Script& script_;
};

std::string as_typed(const std::string& text) { return text; }
template <typename T>
std::string as_typed(const T& value) {
    if constexpr (std::is_integral_v<T>) return std::to_string(value);
    else return std::string(name_of(value));
}

}  // namespace

void add_option_statements(Script& script) {
    const Overrides& asked = script.overrides;
    OptionStatements statements(script);
    if (asked.grid) statements.add_grid(*asked.grid, asked.grid_is_one_number);
    if (asked.model) statements.add_model(*asked.model);
#define CASCADE_OVERRIDE(type, member, of_domain, is_statement, ...) \
    if (is_statement && asked.member) statements.add(#member, as_typed(*asked.member));
#include "run/script/override_options.def"
    if (asked.fast) statements.add("fast");
    if (asked.detail > 1) statements.add("detail", std::to_string(asked.detail));
    if (asked.coarse > 1) statements.add("coarse", std::to_string(asked.coarse));
}

}  // namespace cascade
