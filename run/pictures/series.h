// The fields of a run at its intervals: arrays that grow, or for ParaView a file for each moment
// and a list of them.
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

/// The numbers of a field in a file.
using FieldNumbers = std::function<std::vector<float>(const Field& field)>;
/// A channel for each species of the stage shown, with these numbers of its field.
std::vector<Channel> species_channels(const Simulation& simulation, const FieldNumbers& numbers);
/// The numbers of a field at the cells of a model, in the order of files.
std::vector<float> numbers_of_cells(const Field& field, const ModelCells& model);

/// Writes the species of the stage shown, on a grid, in the format of the path's ending, with these
/// texts if the format holds any. Hides cells outside of the mask.
Result<void> write_volume(const std::filesystem::path& path, const Simulation& simulation,
                          const std::map<std::string, std::string>& texts = {});

/// The time from the start of the run to the present moment of the stage shown; NaN if steps have
/// no length.
double time_since_start(const Simulation& simulation);

/// The fields of arrays, at any moment of a run.
struct SeriesFields {
    std::vector<std::string> names;
    /// By name, in all cells of the domain; empty where a name has no meaning in the stage shown.
    std::function<std::vector<Field>(const Simulation& simulation)> values;
};

/// What a series has written.
struct WrittenSeries {
    std::vector<std::filesystem::path> paths;
    std::size_t removed = 0;  ///< Files of a former series.
};

class SeriesWriter {
public:
    SeriesWriter() = default;
    SeriesWriter(const SeriesWriter&) = delete;
    SeriesWriter& operator=(const SeriesWriter&) = delete;
    virtual ~SeriesWriter() = default;

    /// Adds the present moment. An error is remembered for finish(), and nothing is added after it.
    virtual void add(const Simulation& simulation) = 0;
    /// Completes what was written, also after a cancelled run, or returns the first error.
    virtual Result<WrittenSeries> finish() = 0;
};

/// A series in the format of the path's ending.
///
/// .pvd: a collection of VTK's files, and in the folder NAME beside it a file for each moment with
/// all species: .vti for a grid, .vtp for a model, whose triangles are refined as for its colours.
///
/// .npy, .csv: the fields in one array (run/pictures/array_series.h).
///
/// Fails if a run that is resumed would replace an earlier series, and if a folder cannot be made.
Result<std::unique_ptr<SeriesWriter>> make_series(const std::filesystem::path& path,
                                                  SeriesFields fields, bool is_resumed);

/// The files of a series that have a name of their own: the list or the array, and what is beside.
std::vector<std::filesystem::path> files_of_series(const std::filesystem::path& path);

}  // namespace cascade
