// Fields have the shape of the grid. On a model a field is one row of cells, in the order in which
// files list the cells. Cells that crawl are in the order of their numbers. Sizes and ranges are
// checked, because files may have been changed.
#include "run/commands/saved_stage.h"

#include "picture/npy.h"
#include "run/commands/saved_numbers.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/bound_kernel.h"
#include "solvers/finite.h"
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

/// The suffix of arrays that contain the species at the last evaluation of `until: steady(…)`.
constexpr std::string_view last_look = ".last";
// These arrays have names that no quantity can have.
constexpr std::string_view numbers_array = "cells-numbers", triangles_array = "cells-triangles";
/// The suffix of arrays that contain the direction in which rates change fastest.
constexpr std::string_view stiffest = ".stiffest";

std::string array_name(const Program& program, std::uint32_t stage, std::string_view what) {
    return fmt::format("{}.{}.npy", program.stages[stage].name, what);
}

std::string with_suffix(std::string_view item, std::string_view suffix) {
    return fmt::format("{}{}", item, suffix);
}

/// Writes the arrays of one stage. After a failure it writes nothing more.
class ArrayWriter {
public:
    ArrayWriter(SavedFolderChange& change, const Simulation& simulation, std::uint32_t stage)
        : change_(change), simulation_(simulation), stage_(stage) {}

    void add(std::string_view what, const Field& field) {
        const SimulationDomain& domain = simulation_.domain();
        if (const auto& mask = domain.mask) {
            return put(what, with_outside(field, *mask, nothing_outside));
        }
        if (domain.model) return put(what, in_one_row(field, *domain.model->cells));
        put(what, field);
    }

    /// Writes an array of crawling cells. Writes nothing if there are no cells.
    void add(std::string_view what, const std::vector<double>& values) {
        if (values.empty()) return;
        Plane<double> row(PlaneLayout(Grid{static_cast<std::int64_t>(values.size()), 1}));
        std::copy(values.begin(), values.end(), row.row(0));
        put(what, Field(std::move(row)));
    }

    const Result<void>& result() const { return result_; }

private:
    void put(std::string_view what, const Field& field) {
        if (!result_) return;
        result_ =
            change_.add(array_name(*simulation_.domain().program, stage_, what), encode_npy(field));
    }

    SavedFolderChange& change_;
    const Simulation& simulation_;
    std::uint32_t stage_;
    Result<void> result_;
};

/// Reads the arrays of one stage. After a failure all further arrays are empty.
class ArrayReader {
public:
    ArrayReader(const std::filesystem::path& folder, const nlohmann::json& manifest,
                const Simulation& simulation, std::uint32_t stage)
        : folder_(folder), manifest_(manifest), simulation_(simulation), stage_(stage) {}

    /// Reads the field of an item, or another array of the same shape.
    Field field(std::string_view what) {
        const Precision precision = simulation_.domain().program->domain.precision;
        const SimulationDomain& domain = simulation_.domain(stage_);
        const auto& model = domain.model;
        const Grid grid =
            model ? Grid{static_cast<std::int64_t>(model->cells->count()), 1} : domain.grid;
        const auto array = read(what, precision);
        if (!array) return {};
        if (!fits(*array, grid)) {
            fail(what, "has another shape");
            return {};
        }
        Field field = to_field(*array, precision);
        if (model) field = in_rows(field, *model->cells);
        // In files, values outside the mask are NaN. In runs they are 0.
        if (domain.mask) field = with_outside(field, *domain.mask, 0);
        return field;
    }

    Field finite_field(std::string_view what) {
        Field result = field(what);
        if (!failure_ && first_not_finite(result)) fail(what, "has a value that is not finite");
        return result;
    }

    /// Reads values of crawling cells, which must be finite.
    std::vector<double> values(std::string_view what) {
        auto array = read(what, Precision::binary64);
        if (!array) return {};
        const bool is_row = array->slices == 1 && array->rows == 1;
        if (count_ == 0) count_ = array->values.size();
        if (!is_row || array->values.size() != count_) fail(what, "has another number of cells");
        if (!std::ranges::all_of(array->values, [](double value) { return std::isfinite(value); }))
            fail(what, "has a value that is not finite");
        return failure_ ? std::vector<double>() : std::move(array->values);
    }

    /// Reads an array of integers with 32 bits.
    std::vector<std::uint32_t> words(std::string_view what) {
        std::vector<std::uint32_t> result;
        for (const double value : values(what)) {
            const bool is_word = value >= 0 && value == std::floor(value) &&
                                 value <= std::numeric_limits<std::uint32_t>::max();
            if (!is_word) fail(what, "has a number that is not a number of cells");
            result.push_back(is_word ? static_cast<std::uint32_t>(value) : 0);
        }
        return result;
    }

    void fail(std::string_view what, std::string_view why) {
        fail(fmt::format("{} {}", array_name(*simulation_.domain().program, stage_, what), why));
    }
    const std::optional<Failure>& failure() const { return failure_; }

private:
    std::optional<NpyArray> read(std::string_view what, Precision precision) {
        if (failure_) return std::nullopt;
        const std::string name = array_name(*simulation_.domain().program, stage_, what);
        const auto file = read_saved_file(folder_, manifest_, name);
        auto array = file ? parse_npy(*file, precision) : tl::unexpected(file.error());
        if (array) return std::move(*array);
        const std::string& why = array.error().message;
        fail(file ? fmt::format("cannot read '{}': {}", name, why) : why);
        return std::nullopt;
    }

    void fail(std::string why) {
        if (!failure_) failure_ = Failure{std::move(why), ""};
    }

    const std::filesystem::path& folder_;
    const nlohmann::json& manifest_;
    const Simulation& simulation_;
    std::uint32_t stage_;
    std::size_t count_ = 0;  ///< The number of crawling cells. 0 before the first array is read.
    std::optional<Failure> failure_;
};

void save_fields(ArrayWriter& arrays, const StageState& state, const Program& program,
                 std::uint32_t stage, nlohmann::json&) {
    const System& system = program.system_of(stage);
    for (const ItemId item : recorded_items(program, stage)) {
        arrays.add(system.item_name(item), state.field(item));
    }
    const std::span<const Field> looked_at = state.watch.last();
    for (std::size_t species = 0; species < looked_at.size(); ++species) {
        arrays.add(with_suffix(species_name(system, species), last_look), looked_at[species]);
    }
}

void save_cells(ArrayWriter& arrays, const StageState& state, const Program& program,
                std::uint32_t stage, nlohmann::json& saved) {
    const TissueRecord record = state.tissue()->record();
    const System& system = program.system_of(stage);
    arrays.add(numbers_array, {record.numbers.begin(), record.numbers.end()});
    arrays.add(triangles_array, {record.triangles.begin(), record.triangles.end()});
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string_view name = system.item_name(item);
        const auto species = system.species_of(item);
        arrays.add(name, species ? record.species[species->index()] : record.kept[item.index()]);
        if (!species || record.stiffest.empty()) continue;
        arrays.add(with_suffix(name, stiffest), record.stiffest[species->index()]);
    }
    saved["cells"] = {{"count", record.numbers.size()},
                      {"next_number", record.next_number},
                      {"births", record.births},
                      {"deaths", record.deaths},
                      {"knows_stiffest", !record.stiffest.empty()},
                      {"time", to_json(record.time)}};
}

/// Whether every cell is on an existing triangle of the surface on which it crawls.
bool are_on_surface(const TissueRecord& record, const Simulation& simulation, std::uint32_t stage) {
    const auto model = simulation.domain().shared_model();
    const auto body = body_under_cells(simulation.state(stage));
    const SurfaceMesh* const surface = model ? &model->mesh : body.get();
    const std::size_t triangles = surface != nullptr ? surface->triangles.size() : 0;
    return std::ranges::all_of(record.triangles, [&](std::uint32_t triangle) {
        return triangle < triangles || triangle == Tissue::no_triangle;
    });
}

Result<void> read_fields(ArrayReader& arrays, const nlohmann::json& manifest,
                         const Simulation& simulation, std::uint32_t stage, StageRecord& record) {
    const Program& program = *simulation.domain().program;
    const System& system = program.system_of(stage);
    // Parameters that were painted have been saved. All others have the values that the start of
    // the stage computes.
    RecordedFields fields;
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string_view name = system.item_name(item);
        const bool is_species = system.is_species(item);
        fields.emplace(name, is_species ? arrays.finite_field(name) : arrays.field(name));
    }
    record.values = std::move(fields);
    std::optional<SavedLook> look;
    const Solver solver = program.stages[stage].time.solver;
    if (!read_json(manifest.at("time"), solver, record, look))
        return failure("its time makes no sense");
    if (look) {
        std::vector<Field> looked_at;
        for (const ItemId item : system.species()) {
            looked_at.push_back(
                arrays.finite_field(with_suffix(system.item_name(item), last_look)));
        }
        if (look->formations.size() != looked_at.size())
            return failure("it does not contain the history of a species");
        record.watch.remember(std::move(looked_at), look->t, std::move(look->formations));
    }
    if (arrays.failure()) return tl::unexpected(*arrays.failure());
    return {};
}

Result<void> read_cells(ArrayReader& arrays, const nlohmann::json& manifest,
                        const Simulation& simulation, std::uint32_t stage, StageRecord& of_stage) {
    const nlohmann::json& saved = manifest.at("cells");
    const Program& program = *simulation.domain().program;
    const System& system = program.system_of(stage);
    TissueRecord record;
    saved.at("next_number").get_to(record.next_number);
    saved.at("births").get_to(record.births);
    saved.at("deaths").get_to(record.deaths);
    const bool has_time = read_json(saved.at("time"), record.time);
    const bool knows_stiffest = saved.at("knows_stiffest").get<bool>();
    const bool has_cells = saved.at("count").get<std::uint64_t>() > 0;
    record.species.resize(system.species_count());
    record.kept.resize(system.item_count());
    if (knows_stiffest) record.stiffest.resize(system.species_count());
    if (has_cells) {
        record.numbers = arrays.words(numbers_array);
        record.triangles = arrays.words(triangles_array);
    }
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string_view name = system.item_name(item);
        const auto species = system.species_of(item);
        if (item == system.frozen_item()) record.frozen = item.index();
        if (!has_cells) continue;
        (species ? record.species[species->index()] : record.kept[item.index()]) =
            arrays.values(name);
        if (!species || !knows_stiffest) continue;
        record.stiffest[species->index()] = arrays.values(with_suffix(name, stiffest));
    }
    if (arrays.failure()) return tl::unexpected(*arrays.failure());
    const bool is_in_order =
        std::ranges::adjacent_find(record.numbers, std::greater_equal<>()) == record.numbers.end();
    if (!is_in_order || (has_cells && record.numbers.back() >= record.next_number)) {
        return failure("the numbers of its cells are not in order");
    }
    if (!are_on_surface(record, simulation, stage))
        return failure("its cells are on triangles that their surface does not have");
    if (!has_time) return failure("the time of its cells is not a valid number");
    of_stage.values = std::make_shared<const TissueRecord>(std::move(record));
    return {};
}

/// How the values of stages of one kind are saved.
struct SavedKind {
    /// The names of the arrays that a stage has besides the arrays of its items.
    std::vector<std::string_view> arrays;
    std::string_view (*second_array)(
        const Stage&);  ///< Returns the suffix of the second array of each species.
    void (*save)(ArrayWriter& arrays, const StageState& state, const Program& program,
                 std::uint32_t stage, nlohmann::json& manifest);
    Result<void> (*read)(ArrayReader& arrays, const nlohmann::json& manifest,
                         const Simulation& simulation, std::uint32_t stage, StageRecord& record);
};

const SavedKind& saved_kind(const System& system) {
    static const SavedKind fields{{},
                                  [](const Stage& stage) {
                                      return stage.time.steady ? last_look : std::string_view();
                                  },
                                  save_fields,
                                  read_fields};
    static const SavedKind cells{{numbers_array, triangles_array},
                                 [](const Stage&) { return stiffest; },
                                 save_cells,
                                 read_cells};
    return system.cells ? cells : fields;
}

}  // namespace

std::vector<std::string> stage_arrays(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    std::vector<std::string> names;
    const auto add = [&](std::string_view what) {
        names.push_back(array_name(program, stage, what));
    };
    const SavedKind& kind = saved_kind(system);
    const std::string_view second = kind.second_array(program.stages[stage]);
    for (const std::string_view array : kind.arrays) add(array);
    for (const ItemId item : recorded_items(program, stage)) {
        const std::string_view name = system.item_name(item);
        add(name);
        if (system.is_species(item) && !second.empty()) add(with_suffix(name, second));
    }
    return names;
}

Result<nlohmann::json> save_stage(SavedFolderChange& change, const Simulation& simulation,
                                  std::uint32_t stage) {
    const Program& program = *simulation.domain().program;
    const StageState& state = simulation.state(stage);
    ArrayWriter arrays(change, simulation, stage);
    nlohmann::json saved{{"name", program.stages[stage].name},
                         {"steps", state.steps},
                         {"done", state.done},
                         {"condition_met", state.condition_met},
                         {"time", to_json(static_cast<const StageMoment&>(state))}};
    saved_kind(program.system_of(stage)).save(arrays, state, program, stage, saved);
    if (!arrays.result()) return tl::unexpected(arrays.result().error());
    return saved;
}

Result<StageRecord> read_stage(const std::filesystem::path& folder, const nlohmann::json& manifest,
                               const nlohmann::json& saved, const Simulation& simulation,
                               std::uint32_t stage) {
    ArrayReader arrays(folder, manifest, simulation, stage);
    StageRecord record;
    saved.at("steps").get_to(record.steps);
    saved.at("done").get_to(record.done);
    record.condition_met = saved.value("condition_met", record.done);
    if (record.steps < 0) return failure("a number of steps is negative");
    const System& system = simulation.domain().program->system_of(stage);
    if (auto good = saved_kind(system).read(arrays, saved, simulation, stage, record); !good)
        return tl::unexpected(good.error());
    return record;
}

}  // namespace cascade
