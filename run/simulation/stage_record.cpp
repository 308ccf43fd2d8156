// A record holds copies.
#include "run/simulation/stage_record.h"

#include "run/simulation/simulation.h"
#include "tissue/tissue.h"

#include <utility>

namespace cascade {

namespace {

std::size_t bytes_of_field(const Field& field) {
    return field.empty() ? 0 : Field::bytes(field.layout(), field.precision());
}

std::size_t bytes_of_cells(const TissueRecord& record) {
    std::size_t values = 0;
    for (const auto* of : {&record.species, &record.stiffest, &record.kept}) {
        for (const std::vector<double>& each : *of) values += each.size();
    }
    return sizeof(double) * values + sizeof(std::uint32_t) * 2 * record.numbers.size();
}

}  // namespace

std::size_t StageRecord::bytes() const {
    std::size_t bytes = cells ? bytes_of_cells(*cells) : 0;
    for (const auto& [name, field] : fields) bytes += bytes_of_field(field);
    for (const Field& field : watch.last()) bytes += bytes_of_field(field);
    return bytes;
}

StageRecord record_of(const StageState& state, const Program& program, std::uint32_t stage,
                      const std::set<std::string>& parameters) {
    StageRecord record{StageMoment(state), {}, {}};
    if (state.tissue) {
        record.cells = std::make_shared<const TissueRecord>(state.tissue->record());
        return record;
    }
    const System& system = program.system_of(stage);
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string name(system.item_name(item));
        if (!system.is_species(item) && !parameters.contains(name)) continue;
        record.fields.emplace(name, state.field(item).clone());
    }
    return record;
}

void restore(Simulation& simulation, std::uint32_t stage, StageRecord record) {
    const Program& program = *simulation.domain().program;
    const System& system = program.system_of(stage);
    simulation.change_stage(stage, [&](StageState& state) {
        static_cast<StageMoment&>(state) = std::move(record);
        if (record.cells) {
            state.tissue = std::make_shared<Tissue>(*record.cells, program.domain.precision);
            return state.go_to(state.steps, record.cells->time.t);
        }
        state.course = {};
        for (const ItemId item : system.items()) {
            const auto found = record.fields.find(system.item_name(item));
            CHECK(found != record.fields.end() || !system.is_species(item),
                  "every species of the stage is given");
            if (found != record.fields.end())
                set_item(state, system, item, std::move(found->second));
        }
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
