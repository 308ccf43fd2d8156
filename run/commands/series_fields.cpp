// All expressions that have a meaning in the stage are evaluated together.
#include "run/commands/series_fields.h"

#include "run/commands/stage_formulas.h"
#include "run/pictures/measured.h"

#include <utility>

namespace cascade {

Result<SeriesFields> series_fields(Script& script, const RunRequest& request, Painter& painter) {
    if (request.fields.empty()) {
        std::string name = name_of_number(script, script.final_stage(), request.picture);
        return SeriesFields{{name.empty() ? "shown" : std::move(name)},
                            [&painter](const Simulation& simulation) {
                                std::vector<Field> fields;
                                fields.push_back(shown_number(painter, simulation));
                                return fields;
                            }};
    }
    auto formulas =
        StageFormulas::create(script, "--field", request.fields, FormulaKind::for_a_cell);
    if (!formulas) return tl::unexpected(formulas.error());
    const auto values = [formulas = *std::move(formulas)](const Simulation& simulation) {
        const std::uint32_t stage = shown_stage(simulation);
        std::vector<Field> known = simulation.evaluate(formulas.known_in(stage), stage);
        auto next = known.begin();
        std::vector<Field> fields;
        for (std::size_t k = 0; k < formulas.count(); ++k) {
            fields.push_back(formulas.at(k, stage) != nullptr ? std::move(*next++) : Field());
        }
        return fields;
    };
    return SeriesFields{request.fields, values};
}

}  // namespace cascade
