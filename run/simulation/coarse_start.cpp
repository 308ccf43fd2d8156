// Restricts and refines whole stage states by core/resample; sides that vary are restricted too.
#include "run/simulation/coarse_start.h"

#include "core/resample.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

constexpr std::int64_t most_steps = 1'000'000'000;

Field restricted_field(const Field& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    return fine.visit(
        [&](const auto& plane) { return Field(restricted(plane, fine_grid, coarse_grid)); });
}

}  // namespace

Program on_coarser_grid(const Program& program, std::uint32_t stage, std::int64_t times) {
    Program result = program;
    result.domain.grid = coarser(program.domain.grid, times);
    Stage& own = result.stages[stage];
    own.time.coarse = 1;
    own.iterations = std::min(most_steps, own.iterations * times * times);
    if (own.time.duration) *own.time.duration *= static_cast<double>(times * times);
    if (own.time.duration_in_steps) *own.time.duration_in_steps *= times * times;
    return result;
}

StageState restricted(const StageState& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    StageState coarse;
    coarse.started = fine.started;
    coarse.done = fine.done;
    coarse.steps = fine.steps;
    coarse.t = fine.t;
    coarse.time = fine.time;
    coarse.numbers = fine.numbers;
    coarse.species_of_item = fine.species_of_item;
    const auto all = [&](const std::vector<Field>& fields, std::vector<Field>& into) {
        for (const Field& field : fields) {
            into.push_back(field.empty() ? Field()
                                         : restricted_field(field, fine_grid, coarse_grid));
        }
    };
    all(fine.fields, coarse.fields);
    all(fine.species, coarse.species);
    all(fine.side_values, coarse.side_values);
    coarse.sides = fine.sides;
    for (SideRules& rules : coarse.sides) {
        rules.spacing = coarse_grid.spacing;
        for (SideRule& rule : rules.at) {
            if (rule.values == nullptr) continue;
            const auto same =
                std::find_if(fine.side_values.begin(), fine.side_values.end(),
                             [&](const Field& values) { return values.address() == rule.values; });
            Field& values =
                coarse.side_values[static_cast<std::size_t>(same - fine.side_values.begin())];
            fill_halo(values, coarse_grid.boundary);
            rule.values = values.address();
        }
    }
    return coarse;
}

InputFiles restricted(const InputFiles& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    return fine.mapped(
        [&](const Field& plane) { return restricted_field(plane, fine_grid, coarse_grid); });
}

void take_refined(StageState& fine, const Grid& fine_grid, StageState& coarse,
                  const Grid& coarse_grid) {
    for (std::size_t s = 0; s < fine.species.size(); ++s) {
        const SideRules sides =
            coarse.sides.empty() ? SideRules(coarse_grid.boundary) : coarse.sides[s];
        Field values = coarse.species[s].visit(
            [&](auto& plane) { return Field(refined(plane, coarse_grid, fine_grid, sides)); });
        if (!fine.frozen.empty()) {
            values.visit([&]<typename Number>(Plane<Number>& plane) {
                const Plane<Number>& old = fine.species[s].plane<Number>();
                for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
                    for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                        if (fine.frozen.row(row)[i]) plane.row(row)[i] = old.row(row)[i];
                    }
                }
            });
        }
        fine.species[s] = std::move(values);
    }
}

}  // namespace cascade
