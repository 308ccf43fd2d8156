// Checks the `domain` block.
#include "core/resample.h"
#include "ir/multiply_add.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/check_growth.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/check/blocks/side_rules.h"
#include "lang/program/models.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace cascade::checking {

namespace {

// 2^31, so that the number of a cell fits into a 32-bit word.
constexpr double most_cells = 2147483648.0;

/// The number of cells along one side of the grid. Reports errors.
std::optional<double> check_side(Workspace& work, const ast::Script& script,
                                 ast::Expression expression) {
    const auto side = check_constant(work, script, expression, "a side of the grid");
    if (!side) return std::nullopt;
    if (!(*side >= 1) || *side != std::floor(*side)) {
        work.diagnostics.error(span_of(script, expression),
                               "a side of the grid must be a whole number of at least 1");
        return std::nullopt;
    }
    return side;
}

void check_grid(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() > 3) {
        work.diagnostics.error(span_of(script, statement.values[3]),
                               "a grid has at most three sides");
        return;
    }
    std::array<std::int64_t, 3> counts{1, 1, 1};
    double cells = 1;
    bool is_sound = true;
    for (std::size_t axis = 0; axis < statement.values.size(); ++axis) {
        const auto side = check_side(work, script, statement.values[axis]);
        is_sound = is_sound && side.has_value();
        if (!side) continue;
        cells *= *side;
        if (cells <= most_cells) counts[axis] = static_cast<std::int64_t>(*side);
    }
    if (!is_sound) return;
    const Span sides =
        join(span_of(script, statement.values.front()), span_of(script, statement.values.back()));
    if (cells < 2) {
        work.diagnostics.error(sides, "a grid needs more than one cell");
        return;
    }
    if (!(cells <= most_cells)) {
        work.diagnostics.error(sides, "the grid is too large",
                               "the largest grid has 2147483648 "
                               "cells");
        return;
    }
    Grid& grid = work.draft->domain.grid;
    const bool was_line = grid.height == 1 && grid.depth == 1;
    if (&statement == find_option(script, "grid") && statement.values.size() == 1 && !was_line) {
        work.diagnostics.warning(sides, fmt::format("this is a line of {} cells", counts[0]),
                                 fmt::format("for a square write --grid {0}x{0}", counts[0]));
    }
    const auto* const product =
        std::get_if<ast::Binary>(&script.expressions[statement.values[0].root].node);
    if (statement.values.size() == 1 && product != nullptr && product->op == Function::multiply) {
        work.diagnostics.warning(sides, fmt::format("this is a line of {} cells", counts[0]),
                                 "commas separate the sides, as in grid: 128, 128");
    }
    grid.width = counts[0];
    grid.height = counts[1];
    grid.depth = counts[2];
}

/// The boundary that a word means: `periodic` or `noflux`. Reports errors.
std::optional<Boundary> check_boundary_word(Workspace& work, const ast::Script& script,
                                            ast::Expression expression) {
    const ast::Expr& value = script.expressions[expression.root];
    if (std::holds_alternative<ast::Garbage>(value.node)) return std::nullopt;
    const auto* name = std::get_if<ast::Name>(&value.node);
    const std::string_view word = name != nullptr ? name->name : std::string_view();
    if (word == "periodic") return Boundary::periodic;
    if (word == "noflux") return Boundary::no_flux;
    const auto* call = std::get_if<ast::Call>(&value.node);
    std::string hint(advice_about(call ? call->function.text : word, WordContext::boundary));
    if (const auto* text = std::get_if<ast::Text>(&value.node)) {
        hint = fmt::format("write {} without quotes",
                           text->value == "periodic" ? "periodic" : "noflux");
    }
    if (hint.empty()) hint = did_you_mean(work, word, words_taken_by(Setting::boundary));
    work.diagnostics.error(value.span, "the boundary must be periodic or noflux", std::move(hint));
    return std::nullopt;
}

/// Sets the boundary. The statement gives one word for all axes, or one word for each axis.
void check_boundary(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (statement.values.size() > 3) {
        work.diagnostics.error(
            span_of(script, statement.values[3]),
            "the boundary takes one word, or one word for each axis (at most three)");
        return;
    }
    std::vector<Boundary> along;
    for (const ast::Expression value : statement.values) {
        const auto boundary = check_boundary_word(work, script, value);
        if (!boundary) return;
        along.push_back(*boundary);
    }
    Boundaries& target = work.draft->domain.grid.boundary;
    target = Boundaries(along[0]);
    if (along.size() > 1) target.y = along[1];
    if (along.size() > 1) target.z = along.size() > 2 ? along[2] : Boundary::periodic;
}

/// Sets the mask. The domain consists of the cells in which the mask is not 0.
void check_mask(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    if (!has_one_value(work, script, statement)) return;
    Scope scope;
    scope.context = Context::mask;
    auto checked = check_number(work, script, statement.values[0], scope);
    if (!checked) return;
    work.draft->domain.mask = {std::move(checked->formula), span_of(script, statement.values[0])};
}

/// Reports any stencil other than the cross if the cells are not in straight rows.
void check_place_of_stencil(Workspace& work, const ast::Block& block) {
    const DomainSettings& domain = work.program.domain;
    if (domain.stencil == StencilKind::cross) return;
    const bool is_bent = domain.surface && domain.surface->has_metric;
    if (!is_bent && !domain.mask) return;
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.text != "stencil") continue;
        work.diagnostics.error(
            statement.span,
            fmt::format("the stencil {} needs {}",
                        words_taken_by(Setting::stencil)[static_cast<std::size_t>(domain.stencil)],
                        is_bent ? "square cells, but these cells lie on a surface"
                                : "all cells of the grid, but the domain has a mask"),
            "write stencil: cross");
    }
}

/// Applies --fast. It has no effect on a processor without a multiply-add instruction.
void check_fast(Workspace& work, const ast::Statement& option) {
    work.draft->domain.fast = has_multiply_add();
    if (work.program.domain.fast) return;
    work.diagnostics.warning(option.span,
                             "--fast has no effect, because this processor cannot "
                             "multiply and add in one operation");
}

/// Divides the cells of a domain whose other settings have been checked. For example, `detail: 2`
/// halves the sides of cells.
void check_detail(Workspace& work, const ast::Script& script, const ast::Statement& option) {
    const auto detail = check_constant(work, script, option.values[0], "detail");
    if (!detail) return;
    DomainSettings& domain = work.draft->domain;
    domain.detail = static_cast<std::int64_t>(*detail);
    double cells = 0;
    if (domain.model) {
        domain.model->count *= domain.detail * domain.detail;
        cells = static_cast<double>(domain.model->count);
        if (cells <= most_model_cells) domain.grid = rows_of_cells(domain.model->count);
    } else {
        const bool has_metric = domain.surface && domain.surface->has_metric;
        domain.grid = finer_grid(domain.grid, domain.detail);
        // With a metric, the areas of cells come from the metric.
        if (has_metric) domain.grid.spacing = 1;
        cells = static_cast<double>(domain.grid.width) * static_cast<double>(domain.grid.height) *
                static_cast<double>(domain.grid.depth);
    }
    const double most = domain.model ? most_model_cells : most_cells;
    if (cells <= most) return;
    work.diagnostics.error(option.span, fmt::format("the domain would have {:.0f} cells", cells),
                           fmt::format("a domain has at most {:.0f} cells", most));
}

/// Joins cells of a domain whose other settings have been checked, for stages on a coarser grid.
/// The number of cells along each side must be a multiple of `coarse`.
void check_coarse_domain(Workspace& work, const ast::Script& script, const ast::Statement& option) {
    const auto times = check_constant(work, script, option.values[0], "coarse");
    if (!times) return;
    DomainSettings& domain = work.draft->domain;
    domain.coarse = static_cast<std::int64_t>(*times);
    domain.grid = coarser(domain.grid, domain.coarse);
}

void report_no_setting(Workspace& work, const ast::Word& name) {
    std::string hint = hint_about(work, name.text, WordContext::domain,
                                  settings_of({SettingBlock::domain, SettingBlock::side}));
    if (hint.empty()) {
        hint =
            "the settings of a domain are grid, extent, spacing, boundary, sides, mask, stencil, "
            "precision, seed, surface and mesh";
    }
    work.diagnostics.error(name.span, fmt::format("'{}' is not a setting of the domain", name.text),
                           std::move(hint));
}

/// A hint about ranges such as `extent: 0 .. 10, 0 .. 10`. The hint contains the lengths of these
/// ranges.
std::string hint_of_ranges(const ast::Script& script, const ast::Statement& statement) {
    std::string lengths;
    for (std::size_t k = 0; k + 1 < statement.values.size(); k += 2) {
        const auto number = [&](std::size_t at) {
            const ast::Expr& value = script.expressions[statement.values[at].root];
            const auto* const literal = std::get_if<ast::Number>(&value.node);
            return literal != nullptr ? literal->value : NAN;
        };
        const double length = number(k + 1) - number(k);
        if (length > 0) lengths += fmt::format("{}{:g}", lengths.empty() ? "" : ", ", length);
    }
    return fmt::format("write one number for each side, as in 'extent: {}'",
                       lengths.empty() ? "10, 10" : lengths);
}

void check_domain_statement(Workspace& work, const ast::Script& script,
                            const ast::Statement& statement) {
    if (statement.kind != ast::StatementKind::value) {
        const std::string_view name = statement.name.text;
        work.diagnostics.error(statement.span, "only settings (name: …) belong in the domain",
                               name == "extent" ? hint_of_ranges(script, statement)
                               : is_setting_of(SettingBlock::domain, name)
                                   ? fmt::format("write '{}: …'", name)
                               : name == "x" || name == "y" || name == "z"
                                   ? "coordinates begin at 0: write 'extent: 10, 10' for lengths"
                                   : "");
        return;
    }
    const std::string_view name = statement.name.text;
    if (is_side_word(name)) return check_domain_side(work, script, statement);
    if (!is_setting_of(SettingBlock::domain, name)) return report_no_setting(work, statement.name);
    DomainSettings& domain = work.draft->domain;
    switch (*setting_named(name)) {
        case Setting::grid: return check_grid(work, script, statement);
        case Setting::boundary: return check_boundary(work, script, statement);
        case Setting::spacing:
            return put(domain.grid.spacing, read_number(work, script, statement));
        case Setting::extent:
        // check_domain() checks these settings after the grid and its lengths.
        case Setting::mask: return;
        case Setting::seed: return put(domain.seed, read_number(work, script, statement));
        case Setting::stencil: return put(domain.stencil, read_word(work, script, statement));
        case Setting::precision: return put(domain.precision, read_word(work, script, statement));
        default: return;  // check_domain() checks the settings of surfaces and models.
    }
}

}  // namespace

void check_domain(Workspace& work, const ast::Script& script) {
    const ast::Block* written = find_block(work, script, ast::BlockKind::domain, "domain");
    ast::Block block = written == nullptr ? ast::Block() : *written;
    for (const ast::Override& change : script.overrides) {
        if (value_statement(change.statement) == nullptr || !is_of_domain(script, change)) continue;
        std::erase_if(block.statements, [](const ast::Statement& each) {
            return each.name.text == "extent" || each.name.text == "spacing" ||
                   each.name.text == "unit";
        });
        block.statements.push_back(change.statement);
    }
    std::unordered_map<std::string, Span> seen;
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.empty() || statement.values.empty()) continue;
        const auto [first, is_new] =
            seen.try_emplace(std::string(statement.name.text), statement.name.span);
        if (is_new) {
            check_domain_statement(work, script, statement);
        } else {
            report_twice(work, statement.name.span, first->second,
                         fmt::format("'{}' is given a value twice", statement.name.text));
        }
    }
    report_sides(work, block);
    for (const std::string_view name : {"grid", "seed", "precision"}) {
        if (const auto* option = find_option(script, name))
            check_domain_statement(work, script, *option);
    }
    const ast::Statement* extent = nullptr;
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.text != "extent" || value_statement(statement) == nullptr) continue;
        if (!seen.contains("spacing")) {
            extent = &statement;
            break;
        }
        report_twice(work, statement.name.span, seen.at("spacing"),
                     "a domain can have an extent or a spacing, but not both");
    }
    const ExtentOf subject = subject_of_extent(script, block);
    if (extent != nullptr && subject == ExtentOf::grid) check_extent(work, script, *extent);
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.text == "mask" && !statement.values.empty() &&
            statement.kind == ast::StatementKind::value) {
            check_mask(work, script, statement);
            break;
        }
    }
    if (const auto* option = find_option(script, "fast")) check_fast(work, *option);
    if (!check_model(work, script, block)) {
        check_surface(work, script, block);
        check_place_of_stencil(work, block);
        auto& border = work.draft->domain.sides.back();
        if (border && !work.program.domain.mask) {
            leave_border(work, *border);
            border.reset();
        }
    }
    const DomainSettings& domain = work.program.domain;
    if (extent != nullptr && subject == ExtentOf::surface && (domain.model || domain.surface)) {
        check_extent_of_surface(work, script, *extent);
    }
    if (const auto* option = find_option(script, "detail")) check_detail(work, script, *option);
    if (const auto* option = find_option(script, "coarse"))
        check_coarse_domain(work, script, *option);
}

}  // namespace cascade::checking
