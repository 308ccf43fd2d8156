// Cells kept in a file, for the next time that the same ones are asked for.
//
// The file is, in the byte order of the machine that wrote it: eight letters "CASCELLS", the
// version, a mark of the byte order, the hash of all that the cells were made of, the numbers of
// cells and Voronoi edges and the bare area; then places, areas, ends and edges; and a checksum
// (FNV-1a, 64 bits) of everything before it.
#pragma once

#include "core/result.h"
#include "surface/make_cells.h"

#include <filesystem>

namespace cascade {

/// Raised when the file's form changes, or when the same surface and options give other cells than
/// before.
inline constexpr std::uint32_t cell_file_version = 2;

/// A hash of the surface and of all that decides what cells it gets. Cells may be used again if and
/// only if it is the same; two different ones agree once in 2¹²⁸.
struct CellKey {
    std::array<std::uint64_t, 2> words{};
    friend bool operator==(const CellKey&, const CellKey&) = default;
    std::string text() const;  ///< 32 hexadecimal digits, for the name of a file.
};
CellKey key_of(const SurfaceMesh& mesh, const CellOptions& options);

/// Writes by a rename, so that nobody sees half a file.
Result<void> write_cells(const std::filesystem::path& path, const SurfaceCells& cells,
                         const CellKey& key);

/// The cells of a file written with this key for this surface. Fails, saying why, on a file that is
/// missing, no file of cells, of another version or byte order, made of something else, truncated,
/// or damaged in any bit. No more is allocated than the file's size allows, and cells that are
/// returned are sound: every number names something, edges are symmetric, lengths are finite and
/// above 0. Throws std::bad_alloc.
Result<SurfaceCells> read_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                                const CellKey& key);

/// The cells from the file if it holds these; otherwise they are made and written there.
struct KeptCells {
    SurfaceCells cells;
    bool were_kept = false;  ///< They came from the file.
    std::string not_kept;    ///< Why the file could not be written; empty if it was.
};
Result<KeptCells> kept_cells(const std::filesystem::path& path, const SurfaceMesh& mesh,
                             const CellOptions& options, Team& team,
                             const std::atomic<bool>& cancel);

}  // namespace cascade
