// Replays steps to find the step that spoiled a value.
#include "solvers/spoiled_step.h"

#include "core/check.h"
#include "solvers/finite.h"

namespace cascade {

std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step,
                                         std::int64_t last_finite) {
    for (std::size_t k = 0; k < species.size(); ++k) {
        if (const auto place = first_not_finite(species[k])) {
            return NotFinite{k, place->column, place->row, step, last_finite};
        }
    }
    return std::nullopt;
}

std::int64_t replay(Stepper& stepper, std::int64_t last_finite, std::int64_t spoiled,
                    StageOutcome& outcome) {
    if (!stepper.roles().keeps()) {
        outcome.not_finite = find_not_finite(stepper.species(), spoiled, last_finite);
        return spoiled;
    }
    // If the replay is abandoned, this is the outcome.
    outcome.not_finite = find_not_finite(stepper.species(), spoiled, last_finite);
    stepper.back();
    for (const Field& field : stepper.species()) outcome.last_checked.push_back(field.clone());
    for (std::int64_t step = last_finite; step < spoiled; ++step) {
        const CopyRoles before = stepper.roles();
        bool is_finite = false;
        if (!complete([&] { is_finite = stepper.advance(step, 1, true); })) return step;
        if (is_finite) continue;
        outcome.not_finite = find_not_finite(stepper.species(), step + 1, step);
        stepper.set_roles(before);
        return step;
    }
    CHECK(false, "a replay takes the same steps");
}

}  // namespace cascade
