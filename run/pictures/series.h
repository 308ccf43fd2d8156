// Writes the fields of a run at its intervals. They are written as arrays that grow or, for
// ParaView, as a file for each moment and a list of these files.
#pragma once

#include "core/result.h"
#include "export/channels.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

/// Returns the numbers that a file contains for a field.
using FieldNumbers = std::function<std::vector<float>(const Field& field)>;
/// Makes a channel for each species of the shown stage. `numbers` converts the field of a species
/// to numbers.
std::vector<Channel> species_channels(const Simulation& simulation, const FieldNumbers& numbers);
/// Returns the numbers of a field in the cells of a model, in the order in which files list the
/// cells.
std::vector<float> numbers_of_cells(const Field& field, const ModelCells& model);

/// Writes the species of the shown stage on a grid. The ending of the path determines the format.
/// `texts` are written if the format has room for texts. Cells outside the mask are marked as
/// hidden.
Result<void> write_volume(const std::filesystem::path& path, const Simulation& simulation,
                          const std::map<std::string, std::string>& texts = {});

/// Returns the time from the start of the run to the present moment of the shown stage, or NaN if
/// `speed` varies.
double time_since_start(const Simulation& simulation);

/// Fields for a series. They can be computed at any moment of a run.
struct SeriesFields {
    std::vector<std::string> names;
    std::vector<std::string> expressions;  ///< The expressions of the fields.
    /// The units of the fields, of lengths and of times. Empty where the script gives no unit.
    std::vector<std::string> units;
    std::string unit_of_length, unit_of_time;
    /// Texts for formats that hold them, such as the script.
    std::map<std::string, std::string> texts;
    /// Returns a field for each name, in all cells of the domain. A field is empty if its name has
    /// no meaning in the shown stage.
    std::function<std::vector<Field>(const Simulation& simulation)> values;
};

/// The files that a series has written.
struct WrittenSeries {
    std::vector<std::filesystem::path> paths;
    std::size_t removed = 0;  ///< The number of files of an earlier series that were removed.
};

class SeriesWriter {
public:
    SeriesWriter() = default;
    SeriesWriter(const SeriesWriter&) = delete;
    SeriesWriter& operator=(const SeriesWriter&) = delete;
    virtual ~SeriesWriter() = default;

    /// Adds the present moment. After the first error nothing more is added, and finish() returns
    /// that error.
    virtual void add(const Simulation& simulation) = 0;
    /// Completes the files, also after a cancelled run. Returns the first error, if there was one.
    virtual Result<WrittenSeries> finish() = 0;
};

/// Makes a series in the format of the path's ending.
///
/// .pvd is a collection of VTK files. NAME.pvd is a list, and the folder NAME contains for each
/// moment a file with all species. This file is a .vti for a grid and a .vtp for a model. The
/// triangles of the model are refined for its colours.
///
/// .npy and .csv contain all fields as one array (run/pictures/array_series.h). .h5 contains each
/// field as a dataset (run/pictures/hdf5_series.h).
///
/// Fails if a resumed run would replace an earlier series, or if a folder cannot be made.
Result<std::unique_ptr<SeriesWriter>> make_series(const std::filesystem::path& path,
                                                  SeriesFields fields, bool is_resumed);

/// Returns the files of a series whose names are known before the run: the list or the array, and
/// files with fixed names in the same folder.
std::vector<std::filesystem::path> files_of_series(const std::filesystem::path& path);

}  // namespace cascade
