// Reads the `extent` of the domain and of stages.
#include "lang/calculus/growth_of_lengths.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/check_growth.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/program/evaluate.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace cascade::checking {

namespace {

// The relative tolerance for lengths that are rounded in a script.
constexpr double same_length = 1e-6;

/// Reads the lengths as formulas of numbers and t. Reports errors.
std::optional<std::vector<Formula>> read_lengths(Workspace& work, const ast::Script& script,
                                                 const ast::Statement& statement) {
    std::vector<Formula> lengths;
    for (const ast::Expression value : statement.values) {
        const Span span = span_of(script, value);
        if (lengths.size() == 3) {
            work.diagnostics.error(span, "the domain has three sides at most");
            return std::nullopt;
        }
        Scope scope;
        scope.context = Context::constant;
        scope.subject = "a side of the domain";
        scope.is_length = true;
        auto checked = check_number(work, script, value, scope);
        if (!checked || !check_unit_of_constant(work, checked->formula, "the extent",
                                                Dimension::of(BaseQuantity::length))) {
            return std::nullopt;
        }
        if (checked->constant) checked->formula = {{Node{*checked->constant, span}}};
        lengths.push_back(std::move(checked->formula));
    }
    return lengths;
}

bool reads_time(const Formula& length) { return holds_in(length, is_moment); }

/// The longest side of a surface or model. Empty if the script does not set it.
std::optional<double> extent_of(const DomainSettings& domain) {
    return domain.model ? domain.model->extent : domain.surface->extent;
}

/// The growth of the domain with these lengths. Reports lengths without a derivative.
std::optional<Growth> read_growth(Workspace& work, const std::vector<Formula>& lengths, Span span) {
    const DomainSettings& domain = work.program.domain;
    auto growth = domain.model || domain.surface ? growth_of_surface(lengths[0], *extent_of(domain))
                                                 : growth_of(lengths, domain.grid);
    if (!growth) {
        work.diagnostics.error(span,
                               "the rate at which this length grows cannot be derived from "
                               "its formula",
                               "the formula may contain sums, products, powers, exp, log, sin "
                               "and so on");
        return std::nullopt;
    }
    growth->span = span;
    return growth;
}

Span span_of_values(const ast::Script& script, const ast::Statement& statement) {
    return join(span_of(script, statement.values.front()),
                span_of(script, statement.values.back()));
}

/// The longest side of a surface or model as a formula. Reports errors.
std::optional<std::vector<Formula>> read_longest_side(Workspace& work, const ast::Script& script,
                                                      const ast::Statement& statement) {
    if (statement.values.size() > 1) {
        work.diagnostics.error(span_of(script, statement.values[1]),
                               "a surface or model has one extent, the length of its longest side",
                               "it grows alike in all directions");
        return std::nullopt;
    }
    return read_lengths(work, script, statement);
}

}  // namespace

bool lengths_may_grow(const Program& program, const ast::Script& script) {
    const auto is_extent = [](const ast::Statement& statement) {
        return statement.name.text == "extent";
    };
    return program.domain.growth ||
           std::ranges::any_of(script.overrides, is_extent, &ast::Override::statement) ||
           std::ranges::any_of(script.blocks, [&](const ast::Block& block) {
               return block.kind != ast::BlockKind::domain &&
                      std::ranges::any_of(block.statements, is_extent);
           });
}

void check_extent(Workspace& work, const ast::Script& script, const ast::Statement& statement) {
    const auto lengths = read_lengths(work, script, statement);
    if (!lengths) return;
    Grid& grid = work.draft->domain.grid;
    const std::array sides{grid.width, grid.height, grid.depth};
    for (std::size_t axis = 0; axis < lengths->size(); ++axis) {
        const Span span = span_of(script, statement.values[axis]);
        const double length = evaluate((*lengths)[axis], BuiltinValues{});
        const double spacing = length / static_cast<double>(sides[axis]);
        if (!(spacing >= least_spacing && spacing <= 1 / least_spacing)) {
            return work.diagnostics.error(span, length > 0
                                                    ? "cells must be from 1e-15 to 1e15 long"
                                                    : "the length of a side must be above 0");
        }
        if (axis == 0) grid.spacing = spacing;
        if (std::abs(spacing - grid.spacing) <= same_length * grid.spacing) continue;
        return work.diagnostics.error(
            span,
            fmt::format("cells would be {:.6g} long along one side and {:.6g} along another",
                        grid.spacing, spacing),
            fmt::format("cells must be as long as they are wide{}: with this grid the side must "
                        "be {:.6g} long",
                        std::ranges::any_of(*lengths, reads_time) ? " at t = 0" : "",
                        grid.spacing * static_cast<double>(sides[axis])));
    }
    if (!std::ranges::any_of(*lengths, reads_time)) return;
    work.draft->domain.growth = read_growth(work, *lengths, span_of_values(script, statement));
}

void check_extent_of_surface(Workspace& work, const ast::Script& script,
                             const ast::Statement& statement) {
    DomainSettings& domain = work.draft->domain;
    const auto extent = read_longest_side(work, script, statement);
    if (!extent) return;
    if ((domain.model ? domain.model->unit : domain.surface->unit).has_value()) {
        return work.diagnostics.error(statement.name.span,
                                      "a surface or model can have an extent or a unit, but not "
                                      "both",
                                      "the extent is the length of the longest side in units, so "
                                      "it sets the unit");
    }
    if (domain.surface && !domain.surface->has_metric) {
        return work.diagnostics.error(statement.name.span, "this surface has no lengths",
                                      "write metric: 1 to measure lengths on the surface");
    }
    const double start = evaluate((*extent)[0], BuiltinValues{});
    if (!(start >= least_spacing && start <= 1 / least_spacing)) {
        return work.diagnostics.error(span_of(script, statement.values[0]),
                                      start > 0 ? "the extent must be from 1e-15 to 1e15"
                                                : "the length of a side must be above 0");
    }
    (domain.model ? domain.model->extent : domain.surface->extent) = start;
    if (!std::ranges::any_of(*extent, reads_time)) return;
    domain.growth = read_growth(work, *extent, span_of_values(script, statement));
}

void check_stage_extent(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        Stage& stage) {
    const DomainSettings& domain = work.program.domain;
    const bool is_surface = domain.model || domain.surface;
    if (is_surface && !extent_of(domain)) {
        return work.diagnostics.error(statement.name.span,
                                      "a stage on a surface or model can set the extent only if "
                                      "the domain has an extent",
                                      "write extent: 40 in the domain, for example, for the "
                                      "length of the longest side");
    }
    const auto lengths = is_surface ? read_longest_side(work, script, statement)
                                    : read_lengths(work, script, statement);
    if (!lengths) return;
    stage.growth = read_growth(work, *lengths, span_of_values(script, statement));
}

void fill_growth(Stage& stage, const DomainSettings& domain, const Settings& own,
                 const Settings& defaults) {
    if (!stage.growth) stage.growth = domain.growth;
    const auto& undiluted = own.undiluted ? own.undiluted : defaults.undiluted;
    if (undiluted) stage.undiluted = *undiluted;
}

}  // namespace cascade::checking
