// Writes cells in space, with their frames and values, as files for other programs: NumPy's .npz
// and VTK's .vtp. Cells of surfaces, which have areas and links, are in export/cell_writer.h.
#pragma once

#include "core/quaternion.h"
#include "core/result.h"
#include "export/channels.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// Cells to write. Refers to its parts, each of which has one element per cell.
struct PlacedCells {
    std::span<const Vector3d> places;
    /// Rotations, of length 1, from the axes of space to the axes of each cell. The cell's y axis
    /// points away from the surface on which the cell sits. Its z axis is the direction in which
    /// scales or hairs are combed.
    std::span<const Quaternion> frames;
    std::span<const double> radii;
    std::span<const Colour> colours;  ///< sRGB. May be empty.
    std::span<const Channel> channels;
};

/// An archive of arrays for numpy.load, all little-endian, for n cells:
///
///     points  n × 3 float64  positions
///     frames  n × 4 float64  rotations as quaternions w, x, y, z
///     radii   n     float64
///     colors  n × 3 float32  if there are any
///
/// Each channel is an array of n × float32 under its name, to which an underscore is added if it is
/// one of the names above. Fails above 4 GiB.
Result<std::string> encode_npz(const PlacedCells& cells);

/// VTK's XML PolyData. Each cell is a vertex at its position. Point data are the y axis of its
/// frame as normal, `frame` (w, x, y, z, as ParaView's glyph filters read it), `radius`, the colour
/// as `color`, and the channels.
std::string encode_vtp(const PlacedCells& cells);

/// Writes the bytes that encode_cells() returns, atomically. Fails as encode_cells(), encode_npz
/// and write_file do.
Result<void> write_cells(const std::filesystem::path& path, const PlacedCells& cells);

}  // namespace cascade
