// Interprets the uniform starting values on one cell; a value that depends on an unknown one is
// unknown.
#include "run/emit_c/known_numbers.h"

#include "ir/interpreter.h"
#include "lang/lower/lower.h"
#include "run/emit_c/placeholders.h"
#include "run/stage/plan_runner.h"

#include <algorithm>

namespace cascade {

namespace {

/// True if a formula reads a number that is unknown.
bool reads_unknown(const Formula& formula, std::uint32_t stage, const KnownNumbers& numbers,
                   const Program& program) {
    return std::any_of(formula.nodes.begin(), formula.nodes.end(), [&](const Node& node) {
        const auto is_unknown = [&](StageItem item) {
            return program.stages[item.stage].uniform[item.item] && !numbers[item.stage][item.item];
        };
        const auto* earlier = node.as<StageItem>();
        if (earlier != nullptr) return is_unknown(*earlier);
        return node.is<ItemId>() && is_unknown({stage, *node.as<ItemId>()});
    });
}

}  // namespace

KnownNumbers known_numbers(const Program& program, std::uint32_t last) {
    KnownNumbers numbers;
    Placeholders places(program, last);
    const auto interpreter = make_interpreter();
    const Grid one{1, 1, Boundary::periodic};
    Team team(1);
    const auto compile = [&](const CellKernel& kernel) {
        return *interpreter->compile(kernel, one.stencil());
    };
    for (std::uint32_t k = 0; k <= last; ++k) {
        const Stage& stage = program.stages[k];
        const StepPlan plan = plan_uniform_start(program, k);
        const auto values = run_plan(plan, compile, places.context(), one, team);
        auto& known = numbers.emplace_back(stage.items.size());
        IdVector<ItemId, std::optional<float>> computed(stage.items.size());
        for (std::size_t r = 0; r < values.size(); ++r) {
            computed[plan.results[r]] = values[r].at(0, 0);
            places.states()[k].numbers[plan.results[r]] = values[r].at(0, 0);
        }
        // In the order of evaluation, so that operands come first.
        for (const ItemId item : stage.order) {
            if (!reads_unknown(stage.items[item], k, numbers, program))
                known[item] = computed[item];
        }
    }
    return numbers;
}

}  // namespace cascade
