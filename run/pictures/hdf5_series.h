// Writes the fields of a run over time as an HDF5 file (picture/hdf5.h). Also writes an XDMF file
// into the same folder, with which ParaView reads the HDF5 file.
#pragma once

#include "core/result.h"
#include "run/pictures/series.h"

#include <filesystem>
#include <memory>

namespace cascade {

/// Makes a series for a domain of any kind. Each field is a dataset whose first axis is time. The
/// name of the field must satisfy is_hdf5_name(). The file can be read after each moment, even if
/// the process is killed. Fails if the file is a pipe or a device. An earlier file of this name is
/// replaced when the first moment is added.
Result<std::unique_ptr<SeriesWriter>> make_hdf5_series(const std::filesystem::path& path,
                                                       SeriesFields fields);

}  // namespace cascade
