// Writes crawling cells to the files of option `-o`: instances or triangles for other programs, and
// tables.
#pragma once

#include "core/result.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/model_files.h"
#include "run/pictures/written_files.h"

#include <filesystem>
#include <span>

namespace cascade {

/// Cells with their surroundings. `colours` are in sRGB, in ascending order of the cells' numbers.
struct GrownCells {
    const Simulation& simulation;
    std::uint32_t stage = 0;
    const DrawnCells& drawn;
    std::span<const Colour> colours;
};

/// Writes cells in the coordinates of the model's file, or of the script if there is no model. .glb
/// and .obj files contain the cells as objects, as pictures show them. .npz and .cells.vtp files
/// contain all values of the cells. A .glb file for which options.is_baked() is true contains only
/// the model, with maps that show the objects and contain `texts`. `texture` replaces the model's
/// texture coordinates unless it is empty. Throws std::bad_alloc. Fails in the same cases as the
/// writers of export/.
Result<WrittenFiles> write_cells(const std::filesystem::path& path, const GrownCells& cells,
                                 const MeshTexture& texture, const ModelFileOptions& options,
                                 const PngTexts& texts);

}  // namespace cascade
