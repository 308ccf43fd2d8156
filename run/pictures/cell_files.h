// Crawling cells as files of `-o`: instances or triangles for other programs, and tables.
#pragma once

#include "core/result.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/model_files.h"
#include "run/pictures/written_files.h"

#include <filesystem>
#include <span>

namespace cascade {

/// Cells, their colours (sRGB, by cell in the order of numbers) and their surroundings.
struct GrownCells {
    const Simulation& simulation;
    std::uint32_t stage = 0;
    const DrawnCells& drawn;
    std::span<const Colour> colours;
};

/// Writes them in the coordinates of the model's file or, without a model, of scripts: .glb and
/// .obj with the things in a picture, .npz and .cells.vtp with the cells and all their values. A
/// .glb that is_baked() is the model alone, with maps that show the things and carry the texts.
/// `texture` are the model's texture coordinates. If it is empty they stay unchanged. Throws
/// std::bad_alloc. Fails as the writers of export/ do.
Result<WrittenFiles> write_cells(const std::filesystem::path& path, const GrownCells& cells,
                                 const MeshTexture& texture, const ModelFileOptions& options,
                                 const PngTexts& texts);

}  // namespace cascade
