// All species of a run at its intervals, for ParaView: a file for each moment, and a list of them.
#pragma once

#include "core/result.h"
#include "export/channels.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
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

/// A collection of VTK's files, NAME.pvd, and in the folder NAME beside it a file for each moment:
/// .vti for a grid, .vtp for a model, whose triangles are refined as for its colours.
class SeriesWriter {
public:
    /// Fails if the folder cannot be made.
    static Result<SeriesWriter> create(const std::filesystem::path& path);
    ~SeriesWriter();
    SeriesWriter(SeriesWriter&&) noexcept;
    SeriesWriter& operator=(SeriesWriter&&) noexcept;

    /// Writes the species of the stage shown. An error is remembered for finish(), and no file is
    /// written after it.
    void add(const Simulation& simulation);

    /// Writes the list, also after a cancelled run, and removes files of the former list that were
    /// not written again. Returns their number, or the first error.
    Result<std::size_t> finish();

private:
    struct Surface;
    explicit SeriesWriter(std::filesystem::path path);
    Result<void> write(const std::filesystem::path& path, const Simulation& simulation);
    Result<void> write_surface(const std::filesystem::path& path, const Simulation& simulation);

    struct Moment {
        std::string file;
        double time = 0;  ///< Since the start of the run. NaN where steps have no length.
    };

    std::filesystem::path path_;
    std::vector<std::string> former_;  ///< The files of the previous list.
    std::vector<Moment> moments_;
    std::unique_ptr<Surface> surface_;  ///< The model's, made on the first use.
    std::optional<Failure> failure_;
};

}  // namespace cascade
