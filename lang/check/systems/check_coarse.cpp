// Checks the number n of coarse(n) when the setting is read. Checks the sides of the grid when the
// whole script is known.
#include "lang/check/systems/check_coarse.h"

#include "lang/check/expressions/setting_words.h"
#include "lang/program/trial_program.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

constexpr std::int64_t most_coarse = 64;
// The coarsest grid must have at least this number of cells along each axis.
constexpr std::int64_t fewest_cells = 4;

/// The reason why a domain cannot have a coarser grid, as a text that follows "a coarser grid, ".
/// Null if the domain can have a coarser grid.
const char* obstacle_in(const DomainSettings& domain) {
    return domain.model     ? "but a model has no coarser grid"
           : domain.surface ? "but a surface has no coarser grid"
           : domain.mask    ? "but a mask has another shape there"
                            : nullptr;
}

/// Reports a side whose number of cells is not a multiple of `times`. Reports a side that would
/// have too few cells.
void check_sides(const Grid& grid, std::int64_t times, Span span, Diagnostics& diagnostics) {
    for (const std::int64_t cells : {grid.width, grid.height, grid.depth}) {
        if (cells == 1 || (cells % times == 0 && cells / times >= fewest_cells)) continue;
        diagnostics.error(span,
                          fmt::format("a side of {} cells cannot be divided into cells {} times "
                                      "as wide",
                                      cells, times),
                          fmt::format("the number of cells must be a multiple of {} and at least "
                                      "{}",
                                      times, fewest_cells * times));
        return;
    }
}

}  // namespace

std::optional<Coarse> check_coarse(Workspace& work, const ast::Script& script,
                                   ast::Expression value, std::string_view setting,
                                   std::string_view meaning) {
    const ast::Expr& written = script.expressions[value.root];
    if (std::holds_alternative<ast::Garbage>(written.node)) return std::nullopt;
    const auto refuse = [&](Span span, std::string message, std::string hint) {
        work.diagnostics.error(span, std::move(message), std::move(hint));
        return std::nullopt;
    };
    const std::string example = fmt::format("write {}: coarse(4), for example", setting);
    if (!std::holds_alternative<ast::Call>(written.node) || word_of(written) != "coarse")
        return refuse(written.span, std::string(meaning), example);
    const auto arguments = arguments_of(script, value);
    if (arguments.size() != 1) {
        return refuse(written.span,
                      "coarse takes one number, which says how many times wider "
                      "the cells are",
                      example);
    }
    const auto times = check_constant(work, script, arguments[0], "coarse");
    if (!times) return std::nullopt;
    for (std::int64_t power = 2; power <= most_coarse; power *= 2) {
        if (static_cast<double>(power) == *times) return Coarse{power, written.span};
    }
    return refuse(script.expressions[arguments[0].root].span,
                  fmt::format("the number in coarse(…) must be 2, 4, 8, … {}", most_coarse),
                  setting == "start"
                      ? "use a power of two, because each grid has cells half as wide as the "
                        "grid before"
                      : "use a power of two, so that each wide cell covers whole cells");
}

void check_coarse_grids(const Program& program, Diagnostics& diagnostics) {
    if (program.domain.coarse > 1) return;  // The script's own domain has already been checked.
    const char* const obstacle = obstacle_in(program.domain);
    for (const Stage& stage : program.stages) {
        const bool starts_there = stage.time.coarse > 1;
        if (!starts_there && stage.coarse == 1) continue;
        const Span span = starts_there ? stage.time.coarse_span : stage.coarse_span;
        if (obstacle != nullptr) {
            diagnostics.error(span, fmt::format("stage '{}' {} on a coarser grid, {}", stage.name,
                                                starts_there ? "starts" : "runs", obstacle));
        } else {
            check_sides(program.domain.grid, stage.coarse * stage.time.coarse, span, diagnostics);
        }
    }
}

void check_sizes(const Program& program, Diagnostics& diagnostics) {
    if (program.domain.coarse > 1) return;  // The script's own domain has already been checked.
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (!program.stages[k].size) continue;
        const auto trial = trial_program(program, k);
        if (!trial) {
            diagnostics.error(trial.error().span, trial.error().message, trial.error().hint);
            continue;
        }
        // On a surface, the size of cells follows from the unit, which is known only during the
        // run.
        const DomainSettings& domain = program.domain;
        if (domain.model || domain.surface) continue;
        const Grid& grid = domain.grid;
        const auto times = static_cast<double>(program.stages[k].coarse);
        if (const auto unfit = unfit_size(*program.stages[k].size, grid.spacing * times,
                                          static_cast<double>(grid.longest_side()) / times)) {
            diagnostics.error(unfit->span, unfit->message, unfit->hint);
        }
    }
}

}  // namespace cascade::checking
