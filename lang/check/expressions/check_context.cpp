// Checks that functions are called only in contexts in which they have a meaning.
#include "lang/check/expressions/expression_checker.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

/// Describes the contexts in which a function may be called; null if it may be called in `context`.
const char* where_it_belongs(Contexts contexts, Context context) {
    const bool at_step = context == Context::rate;
    const bool at_start = context == Context::value || context == Context::mask;
    const bool in_picture = context == Context::picture;
    const auto unless = [](bool is_here, const char* where) { return is_here ? nullptr : where; };
    switch (contexts) {
        case Contexts::any:
        case Contexts::cells: return nullptr;
        case Contexts::steps:
            return unless(at_step || in_picture,
                          "cells have no neighbours before the stage starts");
        case Contexts::rates:
            return unless(at_step, "it belongs in rates and definitions of a system");
        case Contexts::values: return unless(at_start, "it belongs in values (name: …)");
        case Contexts::noisy:
            return unless(at_start || at_step, "pictures have no randomness of their own");
        case Contexts::picture: return unless(in_picture, "colours belong in pictures");
    }
    return nullptr;
}

}  // namespace

bool ExpressionChecker::belongs_here(Function function, Span span) {
    const FunctionInfo& row = info(function);
    const Context context = scope_.context;
    const auto refuse = [&](const char* where) {
        error(span, fmt::format("{} cannot be used here", row.spelling), where);
        return false;
    };
    const bool varies = row.is_aggregate || varies_by_cell(function);
    if (scope_.reads_volumes && function == Function::field) return true;
    if (context == Context::position && !is_elementary(function)) {
        return refuse("a surface can contain numbers, sx, sy and functions of numbers only");
    }
    if (context == Context::shape) {
        const bool is_of_space =
            (row.kind == FunctionKind::geometry && !varies) || function == Function::vector;
        return is_elementary(function) || is_of_space ||
               refuse("a shape can contain functions of numbers and vectors only");
    }
    const bool reads_others = row.is_aggregate || differentiates(function) || is_nonlocal(function);
    if (context == Context::mask && reads_others) {
        return refuse("a mask is computed before the cells have values");
    }
    if (context == Context::mask && needs_model(function)) {
        return refuse("it reads a model, but a mask cuts a plane or a volume");
    }
    const bool is_derivative = row.kind == FunctionKind::derivative;
    if (work_.on_surface && is_derivative && !includes(row.domains, Domains::surface)) {
        return refuse("named second derivatives cannot be used on a surface; lap and div can");
    }
    if (work_.on_surface && function == Function::shifted) {
        return refuse("the rows of a surface are not straight; lap, dx and dy work there");
    }
    if (context == Context::constant && varies) {
        error(span, fmt::format("{} must be one number, but {} {}", scope_.subject, row.spelling,
                                row.is_aggregate ? "is known only in a run" : "varies by cell"));
        return false;
    }
    if (context == Context::bound && varies) {
        return refuse("a bound can contain numbers and parameters only");
    }
    if (row.domains == Domains::crawling && !in_cells()) {
        return refuse("it belongs in a system of cells that crawl");
    }
    if (in_cells() && !includes(row.domains, Domains::crawling) && !needs_model(function)) {
        return refuse("cells that crawl have no grid; lap(e) and sums over neighbours work");
    }
    const char* const where = where_it_belongs(row.places, context);
    // A cell that crawls reads the domain at its own position. The kernel of a convolution is
    // computed before the stage.
    const bool reads_early = row.places == Contexts::values && context == Context::rate &&
                             reads_file(function) && (in_cells() || stands_in_kernel());
    return where == nullptr || reads_early || refuse(where);
}

}  // namespace cascade::checking
