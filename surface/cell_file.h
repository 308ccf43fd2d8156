// Cells stored in a file for later runs.
//
// The file has the byte order of the machine that wrote it. It consists of the letters "CASCELLS",
// the version, a byte order mark, the key, the numbers of cells and Voronoi edges, the bare area,
// the positions, areas, ends and edges, and a checksum (FNV-1a, 64 bits) of everything before it.
#pragma once

#include "core/result.h"
#include "surface/make_cells.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace cascade {

/// Must be increased when the file format changes, or when the same surface and options begin to
/// give different cells.
inline constexpr std::uint32_t cell_file_version = 4;

/// A hash of the surface and of all options that affect its cells. Cells may be reused if and only
/// if they have the key asked for. The probability of a collision is 2⁻¹²⁸.
struct CellKey {
    std::array<std::uint64_t, 2> words{};
    friend bool operator==(const CellKey&, const CellKey&) = default;
    std::string text() const;  ///< The key as 32 hexadecimal digits, for a file name.
};
CellKey key_of(const SurfaceMesh& mesh, const CellOptions& options);

/// The content of a file of cells.
std::string print_cells(const SurfaceCells& cells, const CellKey& key);
/// Parses a file of cells that must have been made for this surface with this key. Fails in the
/// same cases as read_cells(). The message is a clause without a subject, such as "is no file of
/// cells".
Result<SurfaceCells> parse_cells(std::string_view bytes, const SurfaceMesh& mesh,
                                 const CellKey& key);

/// Writes a temporary file and renames it, so that no reader sees an incomplete file.
Result<void> write_cells(const std::filesystem::path& path, const SurfaceCells& cells,
                         const CellKey& key);

/// Reads the cells written with this key for this surface. Fails with the reason if the file is
/// missing, is no file of cells, has another version, byte order or key, or is truncated or damaged
/// in any bit. Allocates no more than the file's size allows. The returned cells are valid: indices
/// are in range, edges are symmetric, lengths are finite and positive. Throws std::bad_alloc.
Result<SurfaceCells> read_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                                const CellKey& key);

/// Cells that are stored in a file. If the file contains cells with the right key, they are read.
/// Otherwise cells are made and written to the file.
struct KeptCells {
    SurfaceCells cells;
    bool were_kept = false;  ///< Whether the cells were read from the file. If not, they were made.
    std::string not_kept;    ///< The reason why the file could not be written, or empty.
};
Result<KeptCells> kept_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                             const CellOptions& options, Team& team,
                             const std::atomic<bool>& cancel);

}  // namespace cascade
