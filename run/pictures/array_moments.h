// The moments of a run as arrays of numbers, for file formats that contain fields over time.
#pragma once

#include "core/growing_file.h"
#include "core/plane.h"
#include "core/result.h"
#include "run/pictures/series.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A moment of the shown stage.
struct ArrayMoment {
    std::uint32_t stage = 0;
    std::string stage_name;
    std::int64_t step = 0;
    double t = 0;     ///< Time since the stage began. NaN if `speed` varies.
    double time = 0;  ///< Time since the start of the run. NaN if `speed` varies.
};

ArrayMoment array_moment(const Simulation& simulation);

/// Returns the number of cells along each axis of an array, the slowest axis first: slices (only of
/// a volume), rows (only if there are several) and columns. On a model, returns the number of all
/// cells.
std::vector<std::int64_t> sides_of_cells(const Simulation& simulation);

/// Appends the values of a field in all cells, in the order of the axes and in the run's precision.
/// If the field is empty, appends NaN for each cell.
void append_cells(std::string& bytes, const Field& field, const Simulation& simulation);

/// Creates a file that begins with `bytes`. The file gets its name when GrowingFile::appear() is
/// called.
Result<std::unique_ptr<GrowingFile>> begin_growing(const std::filesystem::path& path,
                                                   std::string_view bytes);

/// A series whose moments are arrays. A moment is added completely or not at all.
class ArraySeries : public SeriesWriter {
public:
    ArraySeries(std::filesystem::path path, SeriesFields fields);

    void add(const Simulation& simulation) override;
    Result<WrittenSeries> finish() override;

protected:
    const std::filesystem::path& path() const { return path_; }
    const SeriesFields& fields() const { return fields_; }
    const std::vector<std::string>& names() const { return fields_.names; }
    std::vector<Field> values(const Simulation& simulation) const {
        return fields_.values(simulation);
    }
    std::int64_t moments() const { return moments_; }  ///< The number of moments added so far.

private:
    virtual Result<void> add_moment(const Simulation& simulation) = 0;
    virtual Result<void> complete() = 0;

    std::filesystem::path path_;
    SeriesFields fields_;
    std::int64_t moments_ = 0;
    std::optional<Failure> failure_;
};

}  // namespace cascade
