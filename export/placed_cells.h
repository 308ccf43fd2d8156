// Cells in space with their frames and values, as files for other programs: NumPy's .npz and VTK's
// .vtp. Cells of surfaces, which have areas and links, are in export/cell_writer.h.
#pragma once

#include "core/quaternion.h"
#include "core/result.h"
#include "export/channels.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// Refers to its parts, each with one element per cell.
struct PlacedCells {
    std::span<const Vector3d> places;
    /// Rotations, of length 1, from the axes of space to the cell's: y points away from the surface
    /// on which it sits, z in the direction of its combing.
    std::span<const Quaternion> frames;
    std::span<const double> radii;
    std::span<const Colour> colours;  ///< sRGB; empty: none.
    std::span<const Channel> channels;
};

/// An archive of arrays for numpy.load, all little-endian, for n cells:
///
///     points  n × 3 float64  positions
///     frames  n × 4 float64  rotations as quaternions w, x, y, z
///     radii   n     float64
///     colors  n × 3 float32  if there are any
///
/// and each channel as n × float32 under its name, with an underscore added if it is one of these.
/// Fails above 4 GiB.
Result<std::string> encode_npz(const PlacedCells& cells);

/// VTK's XML PolyData: each cell is a vertex at its position, with the y axis of its frame as
/// normal, `frame` (w, x, y, z, as glyph filters of ParaView take it), `radius`, its colour as
/// `color` and the channels as point data.
std::string encode_vtp(const PlacedCells& cells);

/// Writes encode_cells() atomically. Fails as encode_cells(), encode_npz and write_file do.
Result<void> write_cells(const std::filesystem::path& path, const PlacedCells& cells);

}  // namespace cascade
