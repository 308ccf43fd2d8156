// The entries of the file are runs. The axis of the entries has the numbers of the runs, from 0.
#include "run/commands/sweep_data.h"

#include "core/growing_file.h"
#include "core/version.h"
#include "lang/check/check_dimensions.h"
#include "lang/program/stage_kinds.h"
#include "run/commands/find_parameter.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The fields of the last stage, in the order of its species.
struct EndFields {
    std::uint32_t stage = 0;
    std::vector<std::string> names;
};

EndFields end_fields(const Program& program) {
    EndFields fields{static_cast<std::uint32_t>(program.stages.size() - 1), {}};
    const System& system = program.system_of(fields.stage);
    for (const ItemId item : system.species()) fields.names.emplace_back(system.item_name(item));
    return fields;
}

/// The numbers along a side of the cells: positions in the unit of length or, if these differ from
/// run to run, from 0 to 1.
Hdf5Column side_of_cells(const char* name, std::int64_t cells, double spacing, bool is_length,
                         const std::string& unit) {
    Hdf5Column column{name,
                      is_length ? "middle of the cell" : "middle of the cell, 0 to 1",
                      {},
                      is_length ? unit : ""};
    const double side = is_length ? spacing : 1 / static_cast<double>(cells);
    for (std::int64_t k = 0; k < cells; ++k) {
        column.values.push_back((static_cast<double>(k) + 0.5) * side);
    }
    return column;
}

std::vector<Hdf5Column> axes_of_runs(const Program& program, const NpyArray& shape,
                                     bool has_one_spacing, const std::string& unit) {
    if (program.domain.model) return {side_of_cells("cell", shape.columns, 1, false, "")};
    const bool is_length = has_one_spacing && !program.domain.surface;
    const double spacing = program.domain.grid.spacing;
    std::vector<Hdf5Column> axes;
    if (shape.slices > 1)
        axes.push_back(side_of_cells("z", shape.slices, spacing, is_length, unit));
    if (shape.slices > 1 || shape.rows > 1) {
        axes.push_back(side_of_cells("y", shape.rows, spacing, is_length, unit));
    }
    axes.push_back(side_of_cells("x", shape.columns, spacing, is_length, unit));
    return axes;
}

/// A varied value: a number if all values of the name are numbers, else a text.
Hdf5Record record_of_values(const std::string& name, const std::vector<std::string>& values,
                            const Script& script) {
    std::string longest;
    bool is_number = true;
    std::optional<std::string> unit;
    for (const std::string& value : values) {
        const auto number = read_with_unit(value);
        if (number && !unit) unit = number->unit;
        is_number = is_number && number && number->unit == unit;
        if (value.size() > longest.size()) longest = value;
    }
    Hdf5Record record{name, {{"long_name", "varied " + name}}, 0.0};
    if (!is_number) record.largest = longest;
    const bool is_given = unit && !unit->empty();
    const std::string_view shown = is_given ? *unit : unit_of_numbers(script.tree, name);
    if (is_number && !shown.empty()) record.attributes["units"] = std::string(shown);
    return record;
}

std::vector<Hdf5Record> records_of_sweep(const Script& script, const SweepRequest& request,
                                         const SweepPlan& plan) {
    std::vector<Hdf5Record> records = {
        {"run", {{"long_name", "number of the run"}}, std::int64_t{0}}};
    const std::vector<std::string> names = names_of(request.varied);
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::vector<std::string> values;
        for (const PlannedRun& run : plan.runs) values.push_back(run.values[k]);
        records.push_back(record_of_values(names[k], values, script));
    }
    for (const std::string_view name : measure::feature_names()) {
        records.push_back(
            {std::string(name), {{"long_name", fmt::format("feature {}", name)}}, 0.0});
    }
    records.push_back({"steps", {{"long_name", "number of steps of all stages"}}, std::int64_t{0}});
    return records;
}

std::string bytes_of_array(const NpyArray& array, Precision precision) {
    std::string bytes(array.values.size() * bytes_of(precision), '\0');
    char* to = bytes.data();
    for (const double value : array.values) {
        const auto rounded = static_cast<float>(value);
        const bool is_single = precision == Precision::single;
        std::memcpy(to, is_single ? static_cast<const void*>(&rounded) : &value,
                    bytes_of(precision));
        to += bytes_of(precision);
    }
    return bytes;
}

/// The fields that a saved run has at its end.
Result<std::vector<NpyArray>> read_end(const std::filesystem::path& folder,
                                       const Program& program) {
    std::vector<NpyArray> arrays;
    const EndFields fields = end_fields(program);
    for (const std::string& name : fields.names) {
        auto array =
            read_npy(folder / fmt::format("{}.{}.npy", program.stages[fields.stage].name, name),
                     program.domain.precision);
        if (!array) return tl::unexpected(array.error());
        arrays.push_back(*std::move(array));
    }
    return arrays;
}

}  // namespace

bool have_same_shape(const Program& one, const Program& other) {
    const auto cells_of = [](const Program& program) {
        return program.domain.model ? program.domain.model->count : 0;
    };
    const auto size_of = [](const Program& program) {
        const Grid& grid = program.domain.grid;
        return std::array{grid.width, grid.height, grid.depth};
    };
    return cells_of(one) == cells_of(other) && size_of(one) == size_of(other) &&
           one.domain.precision == other.domain.precision;
}

Result<void> check_sweep_data(const Script& script, const SweepRequest& request) {
    const Program& program = *script.program;
    const EndFields fields = end_fields(program);
    if (is_of_cells(program, fields.stage)) {
        return failure("--data writes fields, but the last stage has cells that crawl",
                       "save the runs with --fields");
    }
    std::vector<std::string> names = {"x", "y", "z", "cell", "run", "steps", "script", "overrides"};
    for (const std::string_view name : measure::feature_names()) names.emplace_back(name);
    for (const auto& more : {names_of(request.varied), fields.names}) {
        names.insert(names.end(), more.begin(), more.end());
    }
    std::set<std::string> known;
    for (const std::string& name : names) {
        if (name.find('/') == std::string::npos && known.insert(name).second) continue;
        return failure(fmt::format("'{}' cannot be the name of a dataset in '{}'", name,
                                   request.data.string()),
                       "other datasets have the names x, y, z, run, steps, script, overrides, and "
                       "the names of features and of varied values");
    }
    return check_hdf5(request.data).and_then([&] { return check_can_grow(request.data); });
}

struct SweepData::File {
    std::unique_ptr<GrowingFile> place;  ///< Gives the file its name, and completes it.
    std::unique_ptr<Hdf5File> content;
};

SweepData::SweepData(const Script& script, const SweepRequest& request, const SweepPlan& plan,
                     std::filesystem::path folder)
    : script_(load(script, plan.runs[0])),
      request_(request),
      plan_(plan),
      folder_(std::move(folder)),
      records_(records_of_sweep(script_, request, plan)) {}
SweepData::~SweepData() = default;

Result<void> SweepData::begin(const NpyArray& shape) {
    const Program& program = *script_.program;
    const ProgramUnits units = units_of_program(script_.tree, program);
    const EndFields fields = end_fields(program);
    const System& system = program.system_of(fields.stage);
    Hdf5Layout layout;
    layout.records = records_;
    layout.axes =
        axes_of_runs(program, shape, plan_.has_one_spacing, units.name_of(BaseQuantity::length));
    for (const ItemId item : system.species()) {
        Hdf5Attributes attributes = {
            {"long_name", fmt::format("{} at the end of stage {}", system.item_name(item),
                                      program.stages[fields.stage].name)}};
        const std::string unit = units.name_of(fields.stage, item);
        if (!unit.empty()) attributes["units"] = unit;
        layout.fields.emplace_back(system.item_name(item), std::move(attributes));
    }
    layout.precision = program.domain.precision;
    layout.about = {{"source", fmt::format("Cascade {}", version())},
                    {"seed", static_cast<std::int64_t>(program.domain.seed)}};
    layout.texts = {{"script", script_.text}, {"overrides", overrides_to_json(script_.overrides)}};
    auto place = GrowingFile::create(request_.data);
    if (!place) return tl::unexpected(place.error());
    auto content = begin_hdf5((*place)->temporary_path(), layout, request_.data);
    if (!content) return tl::unexpected(content.error());
    file_ = std::make_unique<File>(File{*std::move(place), *std::move(content)});
    return {};
}

Result<void> SweepData::add(std::size_t number, const SweepResult& result) {
    const std::vector<std::string>& varied = plan_.runs[number].values;
    const auto arrays =
        read_end(folder_ / "fields" / folder_name(request_.varied, varied), *script_.program);
    if (!arrays) return tl::unexpected(arrays.error());
    const bool is_first = !file_;
    if (is_first) {
        if (auto begun = begin((*arrays)[0]); !begun) return begun;
    }
    std::vector<Hdf5Value> values = {static_cast<std::int64_t>(number)};
    for (std::size_t k = 0; k < varied.size(); ++k) {
        const bool is_text = std::holds_alternative<std::string>(records_[k + 1].largest);
        values.push_back(is_text ? Hdf5Value(varied[k])
                                 : Hdf5Value(read_with_unit(varied[k])->number));
    }
    for (const double feature : measure::to_array(*result.features)) values.push_back(feature);
    values.push_back(result.steps);
    std::vector<std::string> bytes;
    for (const NpyArray& array : *arrays) {
        bytes.push_back(bytes_of_array(array, script_.program->domain.precision));
    }
    const auto named = [&](const Result<void>& done) -> Result<void> {
        if (done) return done;
        return failure(fmt::format("cannot write '{}': {}", request_.data.string(),
                                   done.error().message),
                       done.error().hint);
    };
    if (auto done = named(file_->content->add(values, bytes)); !done) return done;
    return is_first ? file_->place->appear() : Result<void>();
}

Result<void> SweepData::add_done(std::span<const std::optional<SweepResult>> results) {
    for (; next_ < results.size() && results[next_]; ++next_) {
        if (results[next_]->failed()) continue;
        if (auto done = add(next_, *results[next_]); !done) return done;
    }
    return {};
}

Result<bool> SweepData::finish(std::span<const std::optional<SweepResult>> results) {
    for (; next_ < results.size(); ++next_) {
        if (!results[next_] || results[next_]->failed()) continue;
        if (auto done = add(next_, *results[next_]); !done) return tl::unexpected(done.error());
    }
    if (!file_) return false;
    auto done = file_->content->close();
    file_->content.reset();
    if (done) done = file_->place->complete();
    if (!done) return tl::unexpected(done.error());
    return true;
}

}  // namespace cascade
