// Checks that functions are called only in contexts in which they have a meaning.
#include "lang/check/expressions/expression_checker.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

/// The contexts in which a function may be called, in words. Null if it may be called in `context`.
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
                          "use it in rates, definitions or pictures: cells have no neighbours "
                          "before the stage starts");
        case Contexts::rates: return unless(at_step, "use it in rates and definitions of a system");
        case Contexts::values: return unless(at_start, "use it in values (name: …)");
        case Contexts::noisy:
            return unless(at_start || at_step,
                          "use it in values, rates or definitions: a "
                          "picture cannot draw random numbers");
        case Contexts::picture: return unless(in_picture, "use it in the picture block");
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
        return refuse("a surface can contain only numbers, sx, sy and functions of numbers");
    }
    if (context == Context::shape) {
        const bool is_of_space =
            (row.kind == FunctionKind::geometry && !varies) || function == Function::vector;
        return is_elementary(function) || is_of_space ||
               refuse("a shape can contain only functions of numbers and vectors");
    }
    const bool reads_others = row.is_aggregate || differentiates(function) || is_nonlocal(function);
    if (context == Context::mask && reads_others) {
        return refuse("leave it out: a mask is computed before the cells have values");
    }
    if (context == Context::mask && needs_model(function)) {
        return refuse("leave it out: it reads a model, but a mask belongs to a plane or a volume");
    }
    const bool is_derivative = row.kind == FunctionKind::derivative;
    if (work_.on_surface && is_derivative && !includes(row.domains, Domains::surface)) {
        return refuse("use lap or div: there are no named second derivatives on a surface");
    }
    if (work_.on_surface && function == Function::shifted) {
        return refuse("use lap, dx or dy: the rows of cells on a surface are not straight");
    }
    if (context == Context::constant && varies) {
        error(span, fmt::format("{} must be one number, but {} {}", scope_.subject, row.spelling,
                                row.is_aggregate ? "is known only in a run" : "varies by cell"));
        return false;
    }
    if (context == Context::bound && varies) {
        return refuse("a bound can contain only numbers and parameters");
    }
    if (row.domains == Domains::crawling && !in_cells()) {
        return refuse("use it in a block of cells that crawl");
    }
    if (in_cells() && !includes(row.domains, Domains::crawling) && !needs_model(function)) {
        return refuse("use lap(e) or sums over neighbours: cells that crawl have no grid");
    }
    const char* const where = where_it_belongs(row.places, context);
    // A crawling cell can read the domain at its own position. The kernel of a convolution can read
    // files, because it is computed before the stage.
    const bool reads_early = row.places == Contexts::values && context == Context::rate &&
                             reads_file(function) && (in_cells() || stands_in_kernel());
    return where == nullptr || reads_early || refuse(where);
}

}  // namespace cascade::checking
