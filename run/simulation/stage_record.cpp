// Copies values into records, and records back into stages.
#include "run/simulation/stage_record.h"

#include "run/simulation/simulation.h"
#include "tissue/tissue.h"

#include <utility>

namespace cascade {

namespace {

std::size_t bytes_of(const Field& field) {
    return field.empty() ? 0 : Field::bytes(field.layout(), field.precision());
}

std::size_t bytes_of(const RecordedFields& fields) {
    std::size_t bytes = 0;
    for (const auto& [name, field] : fields) bytes += bytes_of(field);
    return bytes;
}

std::size_t bytes_of(const RecordedCells& cells) {
    std::size_t values = 0;
    for (const auto* of : {&cells->species, &cells->stiffest, &cells->kept}) {
        for (const std::vector<double>& each : *of) values += each.size();
    }
    return sizeof(double) * values + sizeof(std::uint32_t) * 2 * cells->numbers.size();
}

}  // namespace

std::size_t StageRecord::bytes() const {
    std::size_t bytes = std::visit([](const auto& each) { return bytes_of(each); }, values);
    for (const Field& field : watch.last()) bytes += bytes_of(field);
    return bytes;
}

StageRecord record_of(const StageState& state, const Program& program, std::uint32_t stage,
                      const std::set<std::string>& parameters) {
    StageRecord record{StageMoment(state), {}};
    if (const Tissue* const tissue = state.tissue()) {
        record.values = std::make_shared<const TissueRecord>(tissue->record());
        return record;
    }
    RecordedFields& fields = std::get<RecordedFields>(record.values);
    const System& system = program.system_of(stage);
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string name(system.item_name(item));
        if (!system.is_species(item) && !parameters.contains(name)) continue;
        fields.emplace(name, state.field(item).clone());
    }
    return record;
}

void restore(Simulation& simulation, std::uint32_t stage, StageRecord record) {
    const Program& program = *simulation.domain().program;
    const System& system = program.system_of(stage);
    simulation.change_stage(stage, [&](StageState& state) {
        static_cast<StageMoment&>(state) = std::move(record);
        if (const auto* const cells = std::get_if<RecordedCells>(&record.values)) {
            std::get<TissueState>(state.values).tissue =
                std::make_shared<Tissue>(**cells, program.domain.precision);
            return state.go_to(state.steps, (*cells)->time.t);
        }
        auto& fields = std::get<RecordedFields>(record.values);
        state.course = {};
        std::vector<ItemId> items;
        std::vector<Field> planes;
        for (const ItemId item : system.items()) {
            const auto found = fields.find(system.item_name(item));
            CHECK(found != fields.end() || !system.is_species(item),
                  "every species of the stage is given");
            if (found == fields.end()) continue;
            items.push_back(item);
            planes.push_back(std::move(found->second));
        }
        take_values(state, program, stage, items, planes);
        state.go_to(state.steps, state.t);
    });
}

std::vector<ItemId> recorded_items(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    std::vector<ItemId> result;
    for (const ItemId item : system.items()) {
        if (system.is_species(item) || !program.stages[stage].uniform[item]) result.push_back(item);
    }
    return result;
}

}  // namespace cascade
