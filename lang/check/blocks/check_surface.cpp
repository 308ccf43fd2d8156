// Checks the settings of a domain whose grid is on a surface: surface, metric, unit.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

void check_position(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() == 1 &&
        std::holds_alternative<ast::Name>(value_of(script, statement).node)) {
        const std::string_view word = word_of(value_of(script, statement));
        const std::vector<std::string> shapes = words_taken_by(Setting::surface);
        const std::string near = did_you_mean(work, word, shapes);
        work.diagnostics.error(value_of(script, statement).span,
                               fmt::format("there is no surface '{}'", word),
                               near.empty() ? fmt::format("there are {}", fmt::join(shapes, ", "))
                                            : near);
        return;
    }
    if (statement.values.size() != 3) {
        const auto* const text = std::get_if<ast::Text>(&value_of(script, statement).node);
        const bool is_file = statement.values.size() == 1 && text != nullptr;
        const std::vector<std::string> shapes = words_taken_by(Setting::surface);
        const bool is_name = is_file && std::ranges::find(shapes, text->value) != shapes.end();
        work.diagnostics.error(statement.span,
                               "'surface' takes three expressions, for x, y and z in space",
                               is_name   ? fmt::format("write surface: {}", text->value)
                               : is_file ? "write mesh: \"model.obj\" for a model in a file"
                                         : "for example, surface: sx, sy, 0.1 * sin(2 * pi * sx)");
        return;
    }
    Scope scope;
    scope.context = Context::position;
    std::array<Formula, 3> position;
    for (std::size_t k = 0; k < 3; ++k) {
        auto checked = check_number(work, script, statement.values[k], scope);
        if (!checked) return;
        position[k] = std::move(checked->formula);
    }
    SurfaceSettings& surface = work.draft->domain.surface.emplace();
    surface.position = std::move(position);
    surface.span = statement.name.span;
}

const ast::Statement* find_statement(const ast::Block& block, std::string_view name) {
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.text == name && !statement.values.empty()) return &statement;
    }
    return nullptr;
}

}  // namespace

void check_surface(Workspace& work, const ast::Script& script, const ast::Block& domain) {
    const ast::Statement* surface = find_statement(domain, "surface");
    const ast::Statement* metric = find_statement(domain, "metric");
    const ast::Statement* unit = find_statement(domain, "unit");
    if (surface == nullptr) {
        for (const ast::Statement* lonely : {metric, unit}) {
            if (lonely == nullptr) continue;
            work.diagnostics.error(lonely->name.span, "this setting needs a domain with a surface",
                                   "for example, surface: x, y, z");
        }
        return;
    }
    check_position(work, script, *surface);
    if (!work.program.domain.surface) return;
    const Grid& grid = work.program.domain.grid;
    if (grid.width < 2 || grid.height < 2 || grid.depth > 1) {
        work.diagnostics.error(surface->name.span, "a surface needs a grid with two sides",
                               "for example, grid: 128, 128");
    }
    if (grid.spacing != 1) {
        work.diagnostics.error(surface->name.span,
                               "a domain can have a surface or a spacing, "
                               "but not both",
                               "write unit: … for the length of one unit on the surface");
    }
    SurfaceSettings& settings = *work.draft->domain.surface;
    if (metric != nullptr) put(settings.has_metric, read_number(work, script, *metric));
    if (unit != nullptr) put(settings.unit, read_number(work, script, *unit));
}

}  // namespace cascade::checking
