// Options with a syntax of their own, such as --grid 64x32 and --mesh horse.ply, are put into the
// tree directly; the texts of others are parsed as expressions.
#include "run/script/option_statements.h"

#include "lang/program/models.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

namespace cascade {

namespace {

class OptionStatements {
public:
    explicit OptionStatements(Script& script) : script_(script) {}

    /// `name: text` for `--name text`.
    void add(std::string_view name, const std::string& text) {
        ast::Statement& statement = begin(name, text);
        const auto value = parse_expression(statement.span.source, script_.sources, script_.tree,
                                            script_.diagnostics);
        if (!value) return script_.tree.options.pop_back();
        statement.values.push_back(*value);
    }

    /// A setting without a value.
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

    /// A named surface, else a file.
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

}  // namespace

void add_option_statements(Script& script) {
    const Overrides& asked = script.overrides;
    OptionStatements statements(script);
    if (asked.grid) statements.add_grid(*asked.grid, asked.grid_is_one_number);
    if (asked.model) statements.add_model(*asked.model);
    if (asked.cells) statements.add("cells", *asked.cells);
    if (asked.up) statements.add("up", std::string(name_of(*asked.up)));
    if (asked.facing) statements.add("facing", std::string(name_of(*asked.facing)));
    if (asked.seed) statements.add("seed", std::to_string(*asked.seed));
    if (asked.precision) statements.add("precision", std::string(name_of(*asked.precision)));
    if (asked.fast) statements.add("fast");
    if (asked.detail > 1) statements.add("detail", std::to_string(asked.detail));
    if (asked.coarse > 1) statements.add("coarse", std::to_string(asked.coarse));
    if (asked.solver) statements.add("solver", *asked.solver);
    if (asked.steps) statements.add("steps", std::to_string(*asked.steps));
}

}  // namespace cascade
