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
/// A channel for each species of the stage that is shown, with these numbers of its field.
std::vector<Channel> species_channels(const Simulation& simulation, const FieldNumbers& numbers);
/// The numbers of a field at the cells of a model, in the order of files.
std::vector<float> numbers_of_cells(const Field& field, const ModelCells& model);

/// Writes the species of the stage that is shown, on a grid, in the format of the path's ending,
/// and these texts where it holds some. Cells outside of the mask are hidden.
Result<void> write_volume(const std::filesystem::path& path, const Simulation& simulation,
                          const std::map<std::string, std::string>& texts = {});

/// A collection of VTK's files, NAME.pvd, and in the folder NAME beside it a file for each moment:
/// .vti of a grid, .vtp of a model, whose triangles are refined as for its colours.
class SeriesWriter {
public:
    /// Fails if the folder cannot be made.
    static Result<SeriesWriter> create(const std::filesystem::path& path);
    ~SeriesWriter();
    SeriesWriter(SeriesWriter&&) noexcept;
    SeriesWriter& operator=(SeriesWriter&&) noexcept;

    /// Writes the species of the stage that is shown. An error is remembered for finish(), and
    /// nothing is written after it.
    void add(const Simulation& simulation);

    /// Writes the list, also of a run that was cancelled, and removes files that the former list
    /// named and that were not written again. Returns their number, or the first error.
    Result<std::size_t> finish();

private:
    struct Surface;
    explicit SeriesWriter(std::filesystem::path path);
    Result<void> write(const std::filesystem::path& path, const Simulation& simulation);
    Result<void> write_surface(const std::filesystem::path& path, const Simulation& simulation);

    struct Moment {
        std::string file;
        double time = 0;  ///< Since the start of the run; NaN where steps have no length.
    };

    std::filesystem::path path_;
    std::vector<std::string> former_;  ///< The files of the list that was there before.
    std::vector<Moment> moments_;
    std::unique_ptr<Surface> surface_;  ///< Of a model, when first needed.
    std::optional<Failure> failure_;
};

}  // namespace cascade
