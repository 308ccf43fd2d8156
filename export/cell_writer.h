// Writes cells of a surface with their results as files for other programs: NumPy's .npz and VTK's
// .vtp.
#pragma once

#include "core/file_format.h"
#include "core/result.h"
#include "export/channels.h"
#include "surface/voronoi_cells.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

struct CellResults {
    std::span<const Colour> colours;    ///< sRGB, one per cell. May be empty.
    std::span<const Channel> channels;  ///< Each has one number per cell.
};

/// An archive of arrays for numpy.load, all little-endian, for n cells and m links:
///
///     points   n × 3 float64  positions of the cells
///     normals  n × 3 float64  smooth, of length 1
///     areas    n     float64
///     links    m × 2 uint32   pairs i < j, ascending
///     weights  m     float64  length of the Voronoi edge / distance of the cells
///     colors   n × 3 float32  if there are any
///
/// Each channel is an array of n × float32 under its name, to which an underscore is added if it is
/// one of the names above. A diffusion step is u_i += D dt / areas_i · Σ weights (u_j − u_i). Fails
/// above 4 GiB.
Result<std::string> encode_npz(const SurfaceMesh& mesh, const SurfaceCells& cells,
                               const CellResults& results);

/// VTK's XML PolyData. Each cell is a vertex at its position. Point data are its normal, `area`,
/// the colour as `color`, and the channels.
std::string encode_vtp(const SurfaceMesh& mesh, const SurfaceCells& cells,
                       const CellResults& results);

/// The bytes of a file of cells, in the format of the name's ending, .npz or .vtp. Fails on other
/// endings.
template <typename... Cells>
Result<std::string> encode_cells(const std::filesystem::path& path, const Cells&... cells) {
    if (is_of_format(path, FileFormat::npz)) return encode_npz(cells...);
    if (lower_ending(path) == ".vtp") return encode_vtp(cells...);
    return failure("a file of cells has a name that ends in .npz or .vtp");
}

/// Writes the bytes that encode_cells() returns, atomically. Fails as encode_cells(), encode_npz
/// and write_file do.
Result<void> write_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const SurfaceCells& cells, const CellResults& results);

}  // namespace cascade
