// A size is a constant above 0; whether the pattern of a stage has one is known with the program.
#include "lang/check/check_size.h"

#include "lang/check/check_blocks.h"
#include "lang/program/trial_program.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

constexpr double largest_size = 1e15;

}  // namespace

std::optional<StageSize> check_size(Workspace& work, const ast::Script& script,
                                    const ast::Statement& statement) {
    if (!has_one_value(work, script, statement)) return std::nullopt;
    const auto wanted = check_constant(work, script, statement.values[0], "size");
    if (!wanted) return std::nullopt;
    const Span span = script.expressions[statement.values[0].root].span;
    if (*wanted > 0 && *wanted <= largest_size) return StageSize{*wanted, span};
    work.diagnostics.error(span, "size must be above 0 and at most 1e15",
                           "it is the wavelength of the pattern, from one spot to the next");
    return std::nullopt;
}

void check_sizes(const Program& program, Diagnostics& diagnostics) {
    if (program.domain.coarse > 1) return;  // The domain of the script has been checked.
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (!program.stages[k].size) continue;
        const auto trial = trial_program(program, k);
        if (!trial) {
            diagnostics.error(trial.error().span, trial.error().message, trial.error().hint);
            continue;
        }
        // Cells of surfaces have the size that their unit gives them, which is known in the run.
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
