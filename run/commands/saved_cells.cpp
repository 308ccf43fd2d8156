// The files may have been changed, so sizes and ranges are checked.
#include "run/commands/saved_cells.h"

#include "picture/npy.h"
#include "tissue/tissue.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace cascade {

namespace {

// No quantity has such a name.
constexpr std::string_view numbers_array = "cells-numbers", triangles_array = "cells-triangles";
/// Suffix of the direction in which rates change fastest.
constexpr std::string_view stiffest = ".stiffest";

std::string array_name(const Program& program, std::uint32_t stage, std::string_view what) {
    return fmt::format("{}.{}.npy", program.stages[stage].name, what);
}

std::vector<std::string> names_of_species(const System& system) {
    std::vector<std::string> names;
    for (const ItemId item : system.species()) names.emplace_back(system.item_name(item));
    return names;
}

std::string encode(const std::vector<double>& values) {
    Plane<double> row(PlaneLayout(Grid{static_cast<std::int64_t>(values.size()), 1}));
    std::copy(values.begin(), values.end(), row.row(0));
    return encode_npy(Field(std::move(row)));
}

nlohmann::json to_json(const TissueTime& time) {
    return {{"t", time.t},
            {"steps", time.steps},
            {"step", time.control.step},
            {"error_before", time.control.error_before},
            {"rejected", time.control.rejected},
            {"stiffness", time.stiffness},
            {"estimated_at", time.estimated_at},
            {"last_event", time.last_event},
            {"progress", time.progress},
            {"compared_at", time.compared_at},
            {"compared_births", time.compared_births},
            {"compared_deaths", time.compared_deaths},
            {"compared_cells", time.compared_cells}};
}

TissueTime time_from(const nlohmann::json& json) {
    TissueTime time;
    json.at("t").get_to(time.t);
    json.at("steps").get_to(time.steps);
    json.at("step").get_to(time.control.step);
    json.at("error_before").get_to(time.control.error_before);
    json.at("rejected").get_to(time.control.rejected);
    json.at("stiffness").get_to(time.stiffness);
    json.at("estimated_at").get_to(time.estimated_at);
    json.at("last_event").get_to(time.last_event);
    json.at("progress").get_to(time.progress);
    json.at("compared_at").get_to(time.compared_at);
    json.at("compared_births").get_to(time.compared_births);
    json.at("compared_deaths").get_to(time.compared_deaths);
    json.at("compared_cells").get_to(time.compared_cells);
    return time;
}

bool makes_sense(const TissueTime& time) {
    const auto is_length = [](double number) { return std::isfinite(number) && number >= 0; };
    return is_length(time.t) && time.steps >= 0 && is_length(time.control.step) &&
           is_length(time.control.error_before) && is_length(time.stiffness) &&
           time.estimated_at >= -1 && is_length(time.last_event) && time.last_event <= time.t &&
           is_length(time.progress) && is_length(time.compared_at) && time.compared_births >= 0 &&
           time.compared_deaths >= 0 && time.compared_cells >= 0;
}

/// Reads the arrays of one stage.
class CellReader {
public:
    CellReader(const std::filesystem::path& folder, const nlohmann::json& manifest,
               const Simulation& simulation, std::uint32_t stage)
        : folder_(folder), manifest_(manifest), program_(simulation.program()), stage_(stage) {}

    /// The values of an array, which are finite; nothing if it failed.
    std::vector<double> values(std::string_view what) {
        if (failure_) return {};
        const std::string name = array_name(program_, stage_, what);
        const auto file = read_saved_file(folder_, manifest_, name);
        if (!file) return fail(file.error().message);
        auto array = parse_npy(*file, Precision::binary64);
        if (!array) return fail(fmt::format("cannot read '{}': {}", name, array.error().message));
        const bool is_row = array->slices == 1 && array->rows == 1;
        if (count_ == 0) count_ = array->values.size();
        if (!is_row || array->values.size() != count_) {
            return fail(fmt::format("{} has another number of cells", name));
        }
        if (!std::all_of(array->values.begin(), array->values.end(),
                         [](double value) { return std::isfinite(value); })) {
            return fail(fmt::format("{} has a value that is not finite", name));
        }
        return std::move(array->values);
    }

    /// Whole numbers of 32 bits.
    std::vector<std::uint32_t> words(std::string_view what) {
        std::vector<std::uint32_t> result;
        for (const double value : values(what)) {
            const bool is_word = value >= 0 && value == std::floor(value) &&
                                 value <= std::numeric_limits<std::uint32_t>::max();
            if (!is_word) {
                (void)fail(fmt::format("{} has a number that is none of cells",
                                       array_name(program_, stage_, what)));
                return {};
            }
            result.push_back(static_cast<std::uint32_t>(value));
        }
        return result;
    }

    std::vector<double> fail(std::string why) {
        if (!failure_) failure_ = Failure{std::move(why), ""};
        return {};
    }
    const std::optional<Failure>& failure() const { return failure_; }

private:
    const std::filesystem::path& folder_;
    const nlohmann::json& manifest_;
    const Program& program_;
    std::uint32_t stage_;
    std::size_t count_ = 0;  ///< Of cells; 0 before the first array.
    std::optional<Failure> failure_;
};

/// Values that no rate changes are saved where they differ between cells.
bool is_kept(const Program& program, std::uint32_t stage, ItemId item) {
    return !program.system_of(stage).is_species(item) && !program.stages[stage].uniform[item];
}

}  // namespace

std::vector<std::string> cell_arrays(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    std::vector<std::string> names{array_name(program, stage, numbers_array),
                                   array_name(program, stage, triangles_array)};
    for (const std::string& name : names_of_species(system)) {
        names.push_back(array_name(program, stage, name));
        names.push_back(array_name(program, stage, name + std::string(stiffest)));
    }
    for (const ItemId item : system.items()) {
        if (!is_kept(program, stage, item)) continue;
        names.push_back(array_name(program, stage, system.item_name(item)));
    }
    return names;
}

Result<nlohmann::json> save_cells(SavedFolderChange& change, const Simulation& simulation,
                                  std::uint32_t stage) {
    const Program& program = simulation.program();
    const System& system = program.system_of(stage);
    const TissueRecord record = simulation.state(stage).tissue->record();
    std::optional<Failure> failed;
    const auto add = [&](std::string_view what, const std::vector<double>& values) {
        if (failed || values.empty()) return;
        if (auto done = change.add(array_name(program, stage, what), encode(values)); !done) {
            failed = done.error();
        }
    };
    add(numbers_array, {record.numbers.begin(), record.numbers.end()});
    add(triangles_array, {record.triangles.begin(), record.triangles.end()});
    const std::vector<std::string> names = names_of_species(system);
    for (std::size_t k = 0; k < names.size(); ++k) {
        add(names[k], record.species[k]);
        if (!record.stiffest.empty()) add(names[k] + std::string(stiffest), record.stiffest[k]);
    }
    for (const ItemId item : system.items()) {
        if (is_kept(program, stage, item)) add(system.item_name(item), record.kept[item.index()]);
    }
    if (failed) return tl::unexpected(*failed);
    return nlohmann::json{{"count", record.numbers.size()},
                          {"next_number", record.next_number},
                          {"births", record.births},
                          {"deaths", record.deaths},
                          {"knows_stiffest", !record.stiffest.empty()},
                          {"time", to_json(record.time)}};
}

Result<TissueRecord> read_cells(const std::filesystem::path& folder, const nlohmann::json& manifest,
                                const nlohmann::json& cells, const Simulation& simulation,
                                std::uint32_t stage) {
    const Program& program = simulation.program();
    const System& system = program.system_of(stage);
    TissueRecord record;
    cells.at("next_number").get_to(record.next_number);
    cells.at("births").get_to(record.births);
    cells.at("deaths").get_to(record.deaths);
    record.time = time_from(cells.at("time"));
    record.kept.resize(system.item_count());
    if (const ItemId frozen = system.frozen_item(); is_kept(program, stage, frozen)) {
        record.frozen = frozen.index();
    }
    const bool knows_stiffest = cells.at("knows_stiffest").get<bool>();
    CellReader reader(folder, manifest, simulation, stage);
    const auto names = names_of_species(system);
    const bool has_cells = cells.at("count").get<std::uint64_t>() > 0;
    if (has_cells) {
        record.numbers = reader.words(numbers_array);
        record.triangles = reader.words(triangles_array);
    }
    for (const std::string& name : names) {
        record.species.push_back(has_cells ? reader.values(name) : std::vector<double>());
        if (!knows_stiffest) continue;
        record.stiffest.push_back(has_cells ? reader.values(name + std::string(stiffest))
                                            : std::vector<double>());
    }
    for (const ItemId item : system.items()) {
        if (!has_cells || !is_kept(program, stage, item)) continue;
        record.kept[item.index()] = reader.values(system.item_name(item));
    }
    if (reader.failure()) return tl::unexpected(*reader.failure());
    const bool is_in_order = std::adjacent_find(record.numbers.begin(), record.numbers.end(),
                                                std::greater_equal<>()) == record.numbers.end();
    if (!is_in_order || (has_cells && record.numbers.back() >= record.next_number)) {
        return failure("the numbers of its cells are not in order");
    }
    const auto model = simulation.model();
    const auto body = simulation.body(stage);
    const SurfaceMesh* const surface = model ? &model->mesh : body.get();
    const std::size_t triangles = surface != nullptr ? surface->triangles.size() : 0;
    if (!std::all_of(record.triangles.begin(), record.triangles.end(), [&](std::uint32_t triangle) {
            return triangle < triangles || triangle == Tissue::no_triangle;
        })) {
        return failure("its cells are on triangles that their surface does not have");
    }
    if (!makes_sense(record.time)) return failure("the time of its cells makes no sense");
    return record;
}

}  // namespace cascade
