// A .pvd file is ParaView's collection. It consists of XML with a time and a file for each moment.
#include "run/pictures/series.h"

#include "core/check.h"
#include "core/enough_memory.h"
#include "core/file.h"
#include "core/file_format.h"
#include "export/model_writer.h"
#include "export/point_values.h"
#include "picture/vdb.h"
#include "picture/vti.h"
#include "picture/xml_text.h"
#include "run/domain/domain_mask.h"
#include "run/pictures/array_series.h"
#include "run/pictures/hdf5_series.h"
#include "run/pictures/model_files.h"
#include "run/pictures/refined_model.h"
#include "run/simulation/grown_domain.h"
#include "surface/cell_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <system_error>
#include <utility>

namespace cascade {

namespace {

constexpr std::uint64_t largest_list = std::uint64_t{1} << 26;

std::string name_of_file(const std::filesystem::path& list, std::size_t number, bool is_model) {
    return fmt::format("{}/{:06}.{}", list.stem().string(), number, is_model ? "vtp" : "vti");
}

/// Whether a series with this list could have written a file with the name `file`.
bool is_own(const std::filesystem::path& list, const std::string& file) {
    const std::string begin = list.stem().string() + "/";
    if (!file.starts_with(begin) || file.size() != begin.size() + 10) return false;
    const std::string_view name = std::string_view(file).substr(begin.size());
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return std::all_of(name.begin(), name.begin() + 6, is_digit) &&
           (name.ends_with(".vti") || name.ends_with(".vtp"));
}

/// Returns the files in the list that the series of the list has written.
std::vector<std::string> files_in(const std::filesystem::path& list) {
    std::vector<std::string> files;
    const auto text = read_file(list, largest_list);
    if (!text) return files;
    constexpr std::string_view before = " file=\"";
    for (std::size_t at = 0; (at = text->find(before, at)) != std::string::npos;) {
        at += before.size();
        std::string file = text->substr(at, text->find('"', at) - at);
        if (is_own(list, file)) files.push_back(std::move(file));
    }
    return files;
}

}  // namespace

double time_since_start(const Simulation& simulation) {
    double time = 0;
    const std::uint32_t last = shown_stage(simulation);
    for (std::uint32_t k = 0; k <= last; ++k) time += time_of(simulation, k);
    return time;
}

std::vector<Channel> species_channels(const Simulation& simulation, const FieldNumbers& numbers) {
    const std::uint32_t stage = shown_stage(simulation);
    const System& system = simulation.domain().program->system_of(stage);
    std::vector<Channel> channels;
    for (const ItemId item : system.species()) {
        channels.push_back(
            {std::string(system.item_name(item)), numbers(simulation.field(stage, item))});
    }
    return channels;
}

std::vector<float> numbers_of_cells(const Field& field, const ModelCells& model) {
    const std::vector<double> values = cell_values(field, model);
    return {values.begin(), values.end()};
}

namespace {

struct VolumeRow {
    FileFormat format;
    Result<void> (*write)(const std::filesystem::path& path, const VdbVolume& volume);
};

Result<void> as_vti(const std::filesystem::path& path, const VdbVolume& volume) {
    return write_vti(path, volume.arrays, volume.spacing, volume.inside);
}

constexpr std::array volume_writers = {
    VolumeRow{FileFormat::vti, as_vti},
    VolumeRow{FileFormat::vdb, write_vdb},
};
static_assert(has_all_of(volume_writers, FormatKind::volume));

}  // namespace

Result<void> write_volume(const std::filesystem::path& path, const Simulation& simulation,
                          const std::map<std::string, std::string>& texts) {
    const std::uint32_t stage = shown_stage(simulation);
    const SimulationDomain& domain = simulation.domain();
    const System& system = domain.program->system_of(stage);
    const DomainMask* const mask = domain.inside();
    std::deque<Field> copies;
    std::vector<VolumeArray> arrays;
    for (const ItemId item : system.species()) {
        const Field& field = simulation.field(stage, item);
        if (mask) copies.push_back(with_outside(field, *mask, nothing_outside));
        arrays.push_back({std::string(system.item_name(item)), mask ? &copies.back() : &field});
    }
    const FormatRow* const format = find_format(path);
    const VolumeRow* const writer = format ? row_of(volume_writers, format->format) : nullptr;
    CHECK(writer != nullptr, "the file has the ending of a volume format");
    return writer->write(path, {arrays, cell_lengths(simulation, stage),
                                mask ? &mask->inside : nullptr, texts, domain.stage(stage).name,
                                simulation.state(stage).steps, time_of(simulation, stage)});
}

namespace {

class ParaviewSeries : public SeriesWriter {
public:
    static Result<std::unique_ptr<SeriesWriter>> create(const std::filesystem::path& path,
                                                        SeriesFields);

    void add(const Simulation& simulation) override;
    Result<WrittenSeries> finish() override;

private:
    /// The mesh at whose points a model's cells have values in files.
    struct Surface {
        explicit Surface(const ModelCells& model)
            : team(hardware_threads()),
              mesh(model.mesh_of_file()),
              filter(mesh, model.spread().cells, team),
              refined(refined_for_colours(mesh, model.spread().cells)) {}

        Team team;
        SurfaceMesh mesh;  ///< The mesh in the coordinates of the model's file.
        CellFilter filter;
        RefinedMesh refined;
    };
    struct Moment {
        std::string file;
        double time = 0;  ///< Time since the start of the run. NaN if `speed` varies.
    };

    explicit ParaviewSeries(std::filesystem::path path) : path_(std::move(path)) {}
    Result<void> write(const std::filesystem::path& path, const Simulation& simulation);
    Result<void> write_surface(const std::filesystem::path& path, const Simulation& simulation);

    std::filesystem::path path_;
    std::vector<std::string> former_;  ///< The files of the list that an earlier run has written.
    std::vector<Moment> moments_;
    std::unique_ptr<Surface> surface_;  ///< Only used for models, and made when it is first needed.
    std::optional<Failure> failure_;
};

Result<std::unique_ptr<SeriesWriter>> ParaviewSeries::create(const std::filesystem::path& path,
                                                             SeriesFields) {
    std::unique_ptr<ParaviewSeries> writer(new ParaviewSeries(path));
    std::error_code error;
    const std::filesystem::path folder = path.parent_path() / path.stem();
    std::filesystem::create_directories(folder, error);
    if (error) {
        return failure(fmt::format("cannot make the folder '{}' for the files of '{}': {}",
                                   folder.string(), path.string(), error.message()));
    }
    writer->former_ = files_in(path);
    return writer;
}

void ParaviewSeries::add(const Simulation& simulation) {
    if (failure_) return;
    std::string file =
        name_of_file(path_, moments_.size() + 1, simulation.domain().model.has_value());
    const auto written =
        enough_memory_for([&] { return write(path_.parent_path() / file, simulation); });
    if (!written) {
        failure_ = written.error();
        return;
    }
    moments_.push_back({std::move(file), time_since_start(simulation)});
}

Result<void> ParaviewSeries::write(const std::filesystem::path& path,
                                   const Simulation& simulation) {
    return simulation.domain().model ? write_surface(path, simulation)
                                     : write_volume(path, simulation);
}

Result<void> ParaviewSeries::write_surface(const std::filesystem::path& path,
                                           const Simulation& simulation) {
    const ModelCells& model = *simulation.domain().model->cells;
    if (!surface_) surface_ = std::make_unique<Surface>(model);
    const auto channels = species_channels(simulation, [&](const Field& field) {
        return numbers_of_cells(field, model);
    });
    const auto at_points =
        values_at(surface_->refined.places, surface_->filter, channels, surface_->team);
    return write_model(path, surface_->refined.mesh, {{}, at_points});
}

Result<WrittenSeries> ParaviewSeries::finish() {
    // If any moment has no finite time, the indices of all moments are used as times.
    const bool has_times = std::all_of(moments_.begin(), moments_.end(), [](const Moment& moment) {
        return std::isfinite(moment.time);
    });
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (std::size_t k = 0; k < moments_.size(); ++k) {
        text += fmt::format("    <DataSet timestep=\"{:.8g}\" part=\"0\" file=\"{}\"/>\n",
                            has_times ? moments_[k].time : static_cast<double>(k),
                            xml_escaped(moments_[k].file));
    }
    text += "  </Collection>\n</VTKFile>\n";
    if (auto done = write_file(path_, text); !done) return tl::unexpected(done.error());
    if (failure_) return tl::unexpected(*failure_);
    WrittenSeries written{{path_}, 0};
    for (const std::string& file : former_) {
        const bool is_new = std::any_of(moments_.begin(), moments_.end(),
                                        [&](const Moment& moment) { return moment.file == file; });
        std::error_code error;
        if (!is_new && std::filesystem::remove(path_.parent_path() / file, error))
            ++written.removed;
    }
    return written;
}

struct SeriesRow {
    FileFormat format;
    Result<std::unique_ptr<SeriesWriter>> (*make)(const std::filesystem::path& path,
                                                  SeriesFields fields);
};

constexpr std::array series_writers = {
    SeriesRow{FileFormat::pvd, ParaviewSeries::create},
    SeriesRow{FileFormat::npy, make_npy_series},
    SeriesRow{FileFormat::h5, make_hdf5_series},
    SeriesRow{FileFormat::csv, make_csv_series},
};
static_assert(has_all_of(series_writers, FormatKind::series));

}  // namespace

std::vector<std::filesystem::path> files_of_series(const std::filesystem::path& path) {
    const auto beside = [&](const char* ending) {
        return std::vector{path, std::filesystem::path(path).replace_extension(ending)};
    };
    if (is_of_format(path, FileFormat::npy)) return beside(".json");
    if (is_of_format(path, FileFormat::h5)) return beside(".xdmf");
    return {path};
}

Result<std::unique_ptr<SeriesWriter>> make_series(const std::filesystem::path& path,
                                                  SeriesFields fields, bool is_resumed) {
    std::error_code error;
    if (is_resumed && std::filesystem::exists(path, error)) {
        return failure(
            fmt::format("'{}' holds moments of an earlier run", path.string()),
            "name another file with --series, because a resumed run begins a new series");
    }
    const FormatRow* const format = find_format(path);
    const SeriesRow* const writer = format ? row_of(series_writers, format->format) : nullptr;
    CHECK(writer != nullptr, "the file has the ending of a series");
    return writer->make(path, std::move(fields));
}

}  // namespace cascade
