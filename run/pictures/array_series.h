// The fields of a run over time as one array that can be read at any moment of the run, even if the
// program is killed.
//
// NAME.npy is an array of NumPy: time, the fields if there are several, and the cells (slices, rows
// and columns; a grid of one row has columns alone; cells of a model are in the order of files).
// Each moment is appended, and then the header gets the new length. NAME.json beside it says what
// the axes and fields are, and lists the moments.
//
// NAME.csv has a row for each moment of a grid of one row: stage, step, t, and the cells of each
// field. Columns are named after the field and the middle of the cell, in lengths.
#pragma once

#include "core/result.h"
#include "run/pictures/series.h"

#include <filesystem>
#include <memory>

namespace cascade {

/// Both fail if the file is a pipe or a device. They begin the file at the first moment; until then
/// a former file of this name stays.
Result<std::unique_ptr<SeriesWriter>> make_npy_series(const std::filesystem::path& path,
                                                      SeriesFields fields);
/// For grids of one row.
Result<std::unique_ptr<SeriesWriter>> make_csv_series(const std::filesystem::path& path,
                                                      SeriesFields fields);

}  // namespace cascade
