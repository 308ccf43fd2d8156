// Replaces lengths of the domain by numbers. This is possible because the grid is known before
// expressions in systems, stages and pictures are checked.
#include "lang/check/names/domain_lengths.h"

#include "lang/program/scaled_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::checking {

namespace {

struct Row {
    std::string_view name, builtin;
    double (*factor)(const Grid& grid);
    int axis;
};

double longest(const Grid& grid) { return grid.spacing * static_cast<double>(grid.longest_side()); }

constexpr std::array rows = {
    Row{"x", "x", longest, 0},
    Row{"y", "y", longest, 1},
    Row{"z", "z", longest, 2},
    Row{"width", "",
        [](const Grid& grid) { return grid.spacing * static_cast<double>(grid.width); }, 0},
    Row{"height", "",
        [](const Grid& grid) { return grid.spacing * static_cast<double>(grid.height); }, 1},
    Row{"depth", "",
        [](const Grid& grid) { return grid.spacing * static_cast<double>(grid.depth); }, 2},
    Row{"spacing", "", [](const Grid& grid) { return grid.spacing; }, all_axes},
};

}  // namespace

std::optional<DomainLength> domain_length(Workspace& work, const Scope& scope,
                                          const ast::Word& name) {
    const auto refuse = [&](std::string message, std::string hint) {
        work.diagnostics.error(name.span, std::move(message), std::move(hint));
        return std::nullopt;
    };
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& each) { return each.name == name.text; });
    if (row == rows.end()) {
        return refuse(fmt::format("'{}' is not a length of the domain", name.text),
                      "write domain.x, .y, .z, .width, .height, .depth or .spacing");
    }
    if (scope.context == Context::constant || scope.context == Context::position ||
        scope.context == Context::shape) {
        return refuse("lengths of the domain cannot be read here",
                      "read them in values, rates, definitions, masks or pictures");
    }
    const DomainSettings& domain = work.program.domain;
    if (domain.model || domain.surface) {
        return refuse("lengths of the domain exist only for a grid with straight axes",
                      domain.model ? "x, y and z are from 0 to 1 along the model's longest side"
                                   : "sx and sy are from 0 to 1 along the sides of the surface");
    }
    if (is_of_cells(work, scope)) {
        return refuse("cells that crawl do not lie on the grid",
                      "write p.x, p.y and p.z for the position of a cell");
    }
    return DomainLength{row->builtin, row->factor(domain.grid), row->axis};
}

double content_of_cell(const Program& program) {
    const DomainSettings& domain = program.domain;
    if (domain.model || domain.surface) return 1;
    return std::pow(domain.grid.spacing, axes_of(domain));
}

const ast::Word* name_of_length(const ast::Script& script, const ast::Expr& expr) {
    if (const auto* qualified = std::get_if<ast::Qualified>(&expr.node)) {
        return qualified->stage.text == domain_word ? &qualified->name : nullptr;
    }
    const auto* component = std::get_if<ast::Component>(&expr.node);
    if (component == nullptr) return nullptr;
    const auto* name = std::get_if<ast::Name>(&script.expressions[component->operand].node);
    return name != nullptr && name->name == domain_word ? &component->name : nullptr;
}

bool is_integral(const ast::Over& over) {
    return over.function.text == integral_word && over.index.text == domain_word;
}

}  // namespace cascade::checking
