// Finds calls that draw random numbers. Warns if numbers are drawn in each step while the lengths
// of steps are unknown.
#include "lang/check/chance.h"

#include "lang/check/expressions/setting_words.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

bool draws(const Formula& formula) { return holds_in(formula, is_draw); }

bool draws_by_step(const Node& node) { return is_draw(node) && node.function != Function::white; }

bool draws_random_numbers(const Program& program) {
    if (program.domain.mask && draws(program.domain.mask->formula)) return true;
    return std::any_of(program.stages.begin(), program.stages.end(), [&](const Stage& stage) {
        return holds_in_rates(program.systems[stage.system], is_draw) ||
               holds_in_sides(stage, is_draw) ||
               std::any_of(stage.items.begin(), stage.items.end(), draws);
    });
}

}  // namespace

void warn_of_idle_seed(const ast::Script& script, const Program& program,
                       Diagnostics& diagnostics) {
    const ast::Statement* const seed = checking::find_option(script, "seed");
    // On a model, the seed has an effect even if nothing draws random numbers, because the cells
    // are placed at random.
    if (seed == nullptr || program.stages.empty() || program.domain.model ||
        draws_random_numbers(program)) {
        return;
    }
    diagnostics.warning(seed->span,
                        "the seed has no effect, because nothing in this script is random",
                        "for example, add random(0, 0.01) to a starting value");
}

void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics) {
    for (const Stage& stage : program.stages) {
        if (!stage.time.chooses_steps()) continue;
        const Node* const draw = find_in_rates(program.systems[stage.system], draws_by_step);
        if (draw == nullptr) continue;
        return diagnostics.warning(draw->span,
                                   fmt::format("the strength of this noise depends on the length "
                                               "of the steps, which stage '{}' chooses itself: "
                                               "shorter steps weaken the noise",
                                               stage.name),
                                   "use white(s): its strength does not depend on the length of "
                                   "the steps");
    }
}

}  // namespace cascade
