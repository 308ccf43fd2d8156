// XDMF describes where each moment is in the HDF5 file (www.xdmf.org, "XDMF Model and Format"). The
// list of moments in the XDMF file grows together with the HDF5 file. A moment is listed only after
// it is complete in the HDF5 file.
#include "run/pictures/hdf5_series.h"

#include "core/growing_file.h"
#include "core/version.h"
#include "picture/hdf5.h"
#include "picture/xml_text.h"
#include "run/pictures/array_moments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

namespace {

using Sides = std::vector<std::int64_t>;

/// The middles of cells along an axis.
Hdf5Column axis_of(std::string name, std::int64_t cells, double spacing, std::string meaning,
                   std::string unit) {
    Hdf5Column column{std::move(name), std::move(meaning), {}, std::move(unit)};
    for (std::int64_t k = 0; k < cells; ++k) {
        column.values.push_back((static_cast<double>(k) + 0.5) * spacing);
    }
    return column;
}

void add_axes(Hdf5Layout& layout, const Simulation& simulation, const Sides& sides,
              const std::string& unit) {
    const SimulationDomain& domain = simulation.domain();
    if (const auto model = domain.shared_model()) {
        Hdf5Column numbers{"cell", "number of the cell in files", {}, ""};
        for (std::int64_t k = 0; k < sides[0]; ++k) {
            numbers.values.push_back(static_cast<double>(k));
        }
        layout.axes = {std::move(numbers)};
        constexpr std::array names = {"x", "y", "z"};
        constexpr std::array planes = {ModelPlane::x, ModelPlane::y, ModelPlane::z};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto plane = static_cast<std::size_t>(planes[k]);
            layout.coordinates.push_back({names[k],
                                          fmt::format("{} of the cell, as in formulas", names[k]),
                                          cell_values(model->spread().planes[plane], *model), ""});
        }
        return;
    }
    constexpr std::array names = {"x", "y", "z"};
    const bool is_surface = domain.program->domain.surface.has_value();
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const std::size_t axis = sides.size() - 1 - k;
        const double spacing = is_surface ? 1 / static_cast<double>(sides[k]) : domain.grid.spacing;
        layout.axes.push_back(axis_of(names[axis], sides[k], spacing,
                                      is_surface ? "position on the surface, 0 to 1"
                                                 : "middle of the cell, in units of length",
                                      is_surface ? "" : unit));
    }
}

/// The time and place of each moment. Times without a meaning are NaN.
std::vector<Hdf5Record> records_of_moments(const Program& program, const std::string& unit) {
    std::vector<std::int32_t> numbers;
    std::string names;
    for (const Stage& stage : program.stages) {
        numbers.push_back(static_cast<std::int32_t>(numbers.size()));
        names += (names.empty() ? "" : " ") + stage.name;
    }
    Hdf5Attributes of_run = {{"long_name", "time from the beginning of the run"}};
    Hdf5Attributes of_stage = {{"long_name", "time from the beginning of the stage"}};
    if (!unit.empty()) of_run["units"] = of_stage["units"] = unit;
    return {{"time", of_run, 0.0},
            {"t", of_stage, 0.0},
            {"step", {{"long_name", "number of complete steps of the stage"}}, std::int64_t{0}},
            {"stage",
             {{"long_name", "stage, by its number from 0"},
              {"flag_values", numbers},
              {"flag_meanings", names}},
             std::int32_t{0}}};
}

Hdf5Layout layout_of(const Simulation& simulation, const Sides& sides, const SeriesFields& fields) {
    const Program& program = *simulation.domain().program;
    Hdf5Layout layout;
    layout.records = records_of_moments(program, fields.unit_of_time);
    add_axes(layout, simulation, sides, fields.unit_of_length);
    for (std::size_t k = 0; k < fields.names.size(); ++k) {
        Hdf5Attributes attributes = {{"long_name", fields.expressions[k]}};
        if (!layout.coordinates.empty()) attributes["coordinates"] = "x y z";
        if (!fields.units[k].empty()) attributes["units"] = fields.units[k];
        layout.fields.emplace_back(fields.names[k], std::move(attributes));
    }
    layout.precision = program.domain.precision;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        layout.stages.emplace_back(program.stages[k].name,
                                   Hdf5Attributes{
                                       {"system", program.systems[program.stages[k].system].name}});
    }
    layout.about = {{"source", fmt::format("Cascade {}", version())},
                    {"seed", static_cast<std::int64_t>(program.domain.seed)}};
    if (!program.domain.surface && layout.coordinates.empty()) {
        layout.about["spacing"] = simulation.domain().grid.spacing;
    }
    layout.texts = fields.texts;
    return layout;
}

/// Returns the parameters of a started stage that are the same in all cells.
std::map<std::string, double> numbers_of_stage(const Simulation& simulation, std::uint32_t stage) {
    const System& system = simulation.domain().program->system_of(stage);
    const StageState& state = simulation.state(stage);
    std::map<std::string, double> numbers;
    if (state.tissue()) return numbers;
    for (const ItemId item : system.items()) {
        if (system.is_species(item) || item == system.frozen_item()) continue;
        if (!state.fields().parameters[item].empty()) continue;
        numbers[std::string(system.item_name(item))] = state.numbers[item];
    }
    return numbers;
}

class Hdf5Series : public ArraySeries {
public:
    using ArraySeries::ArraySeries;

private:
    Result<void> add_moment(const Simulation& simulation) override;
    Result<void> begin(const Simulation& simulation);
    Result<void> complete() override;
    Result<void> named(const Result<void>& done) const;
    std::string xdmf_of(const ArrayMoment& moment) const;

    Sides sides_;
    bool is_model_ = false;
    double spacing_ = 1;
    std::size_t bytes_of_number_ = 4;
    std::optional<std::uint32_t>
        described_;                       ///< The last stage whose parameters have been written.
    std::unique_ptr<GrowingFile> place_;  ///< Gives the HDF5 file its name, and completes the file.
    std::unique_ptr<Hdf5File> file_;
    std::unique_ptr<GrowingFile> list_;
    static constexpr std::string_view end_of_list = "  </Grid>\n</Domain>\n</Xdmf>\n";
};

/// Adds the name of the file to an error.
Result<void> Hdf5Series::named(const Result<void>& done) const {
    if (done) return done;
    return failure(fmt::format("cannot write '{}': {}", path().string(), done.error().message),
                   done.error().hint);
}

Result<void> Hdf5Series::begin(const Simulation& simulation) {
    const SimulationDomain& domain = simulation.domain();
    sides_ = sides_of_cells(simulation);
    is_model_ = domain.shared_model() != nullptr;
    spacing_ = domain.grid.spacing;
    bytes_of_number_ = bytes_of(domain.precision());
    auto place = GrowingFile::create(path());
    if (!place) return tl::unexpected(place.error());
    auto file =
        begin_hdf5((*place)->temporary_path(), layout_of(simulation, sides_, fields()), path());
    if (!file) return tl::unexpected(file.error());
    auto list = begin_growing(files_of_series(path())[1],
                              "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
                              "  <Grid GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
                                  std::string(end_of_list));
    if (!list) return tl::unexpected(list.error());
    place_ = *std::move(place);
    file_ = *std::move(file);
    list_ = *std::move(list);
    return {};
}

Result<void> Hdf5Series::add_moment(const Simulation& simulation) {
    const bool is_first = !file_;
    if (is_first) {
        if (auto begun = begin(simulation); !begun) return begun;
    }
    const ArrayMoment moment = array_moment(simulation);
    if (described_ != moment.stage) {
        const auto done = file_->describe(moment.stage, numbers_of_stage(simulation, moment.stage));
        if (!done) return named(done);
        described_ = moment.stage;
    }
    std::vector<std::string> bytes;
    for (Field& field : values(simulation)) {
        bytes.emplace_back();
        if (!field.empty()) append_cells(bytes.back(), field, simulation);
        field = Field();
    }
    const auto done =
        file_->add({moment.time, moment.t, moment.step, static_cast<std::int32_t>(moment.stage)},
                   bytes);
    if (!done) return named(done);
    const auto listed = list_->replace_end(list_->size() - end_of_list.size(),
                                           xdmf_of(moment) + std::string(end_of_list));
    if (!listed || !is_first) return listed;
    auto appeared = place_->appear();
    return appeared ? list_->appear() : appeared;
}

/// Writes a moment as a grid of XDMF. A line or a plane is a grid with one layer of cells. The
/// cells of a model are points.
std::string Hdf5Series::xdmf_of(const ArrayMoment& moment) const {
    const std::string file = xml_escaped(path().filename().string());
    Sides layers = sides_;
    if (!is_model_) layers.insert(layers.begin(), 3 - layers.size(), 1);
    std::string text =
        fmt::format("    <Grid Name=\"{}\">\n      <Time Value=\"{:.17g}\"/>\n",
                    xml_escaped(moment.stage_name),
                    std::isfinite(moment.time) ? moment.time : static_cast<double>(moments()));
    if (is_model_) {
        text += fmt::format(
            "      <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n"
            "      <Geometry GeometryType=\"X_Y_Z\">\n",
            sides_[0]);
        for (const char* axis : {"x", "y", "z"}) {
            text += fmt::format(
                "        <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" "
                "Dimensions=\"{}\">{}:/{}</DataItem>\n",
                sides_[0], file, axis);
        }
    } else {
        text += fmt::format(
            "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{0} {1} {2}\"/>\n"
            "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
            "        <DataItem Format=\"XML\" Dimensions=\"3\">0 0 0</DataItem>\n"
            "        <DataItem Format=\"XML\" Dimensions=\"3\">{3:.9g} {3:.9g} {3:.9g}</DataItem>\n",
            layers[0] + 1, layers[1] + 1, layers[2] + 1, spacing_);
    }
    text += "      </Geometry>\n";
    const std::vector<int> zeros(sides_.size(), 0), ones(sides_.size() + 1, 1);
    for (const std::string& name : names()) {
        text += fmt::format(
            "      <Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"{1}\">\n"
            "        <DataItem ItemType=\"HyperSlab\" Dimensions=\"{2}\">\n"
            "          <DataItem Format=\"XML\" Dimensions=\"3 {3}\">{4} {5} {6} 1 {7}</DataItem>\n"
            "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"{8}\" "
            "Dimensions=\"{9} {7}\">{10}:/{0}</DataItem>\n"
            "        </DataItem>\n      </Attribute>\n",
            xml_escaped(name), is_model_ ? "Node" : "Cell", fmt::join(layers, " "),
            sides_.size() + 1, moments(), fmt::join(zeros, " "), fmt::join(ones, " "),
            fmt::join(sides_, " "), bytes_of_number_, moments() + 1, file);
    }
    return text + "    </Grid>\n";
}

Result<void> Hdf5Series::complete() {
    if (auto closed = named(file_->close()); !closed) return closed;
    file_.reset();
    auto done = place_->complete();
    return done ? list_->complete() : done;
}

}  // namespace

Result<std::unique_ptr<SeriesWriter>> make_hdf5_series(const std::filesystem::path& path,
                                                       SeriesFields fields) {
    for (const auto& file : files_of_series(path)) {
        if (auto can = check_can_grow(file); !can) return tl::unexpected(can.error());
    }
    return std::make_unique<Hdf5Series>(path, std::move(fields));
}

}  // namespace cascade
