// Writes the fields of a run over time as one array. The file can be read at any moment of the run,
// even if the program is killed.
//
// NAME.npy is a NumPy array. Its axes are time, the fields if there are several, and the cells. The
// cells of a grid have the axes slices, rows and columns, or only columns if the grid has one row.
// The cells of a model have a single axis, in the order in which all files list them. Each moment
// is appended to the file, and then the length in the file's header is updated. NAME.json in the
// same folder describes the axes and fields, and lists the moments.
//
// NAME.csv is for grids of one row. It has a row for each moment, with the stage, the step, the
// time t, and the cells of each field. A column is named after its field and the position of its
// cell's centre, in the unit of the grid's spacing.
#pragma once

#include "core/result.h"
#include "run/pictures/series.h"

#include <filesystem>
#include <memory>

namespace cascade {

/// Makes a series for a domain of any kind. Fails if the file is a pipe or a device. An earlier
/// file of this name is replaced when the first moment is added.
Result<std::unique_ptr<SeriesWriter>> make_npy_series(const std::filesystem::path& path,
                                                      SeriesFields fields);
/// Makes a series for a grid of one row. Fails in the same cases as make_npy_series(), and replaces
/// an earlier file in the same way.
Result<std::unique_ptr<SeriesWriter>> make_csv_series(const std::filesystem::path& path,
                                                      SeriesFields fields);

}  // namespace cascade
