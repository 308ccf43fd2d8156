// Whether the pattern of a stage can have its size is known with the program.
#include "lang/check/check_size.h"

#include "lang/program/trial_program.h"

namespace cascade::checking {

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
