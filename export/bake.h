// Baking: what grew on a surface painted into a picture that other programs lay over the model by
// its texture coordinates.
#pragma once

#include "core/result.h"
#include "export/painted_cells.h"
#include "picture/image.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct BakeOptions {
    std::int64_t width = 1024, height = 1024;  ///< Texels, 1 … largest_texture.
    int samples = 2;                           ///< samples × samples in each texel, 1 … 8.
    static constexpr std::int64_t largest_texture = 8192;
};

struct Bake {
    Image colour;
    /// Grey, 0 the smallest and 1 the largest height of a texel, which are `heights`; empty without
    /// any.
    Image relief;
    ValueRange heights;
    /// Directions relative to the tangents of render_vertices(), −1 … 1 as 0 … 1, y upwards; empty
    /// likewise.
    Image normals;
    double covered = 0;      ///< Part of the samples that lie on the surface.
    double overlapping = 0;  ///< Part of the surface in the texture that lies behind another part.
    std::vector<std::string> warnings;  ///< A sentence each.
};

/// Has the model texture coordinates to paint by? Fails, with a hint, where it has none, and where
/// they cover the texture again and again, as those of pictures that repeat do.
Result<void> check_bakeable(const SurfaceMesh& mesh);

/// Paints every texel with the mean, as amounts of light, over its samples on the surface, and all
/// others by going on from those. Texture coordinates beyond 0 … 1 repeat the picture. Heights that
/// are not finite are taken from around. The same on any number of threads. Fails as check_bakeable
/// does, on coordinates that have no area, and where memory is short; gives what means nothing if
/// `cancel` became true.
Result<Bake> bake(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel);

/// The files that write_baked makes: the model itself, then NAME_color.png and, with heights,
/// NAME_height.png and NAME_normal.png (16 bits) beside it.
std::vector<std::filesystem::path> baked_paths(const std::filesystem::path& glb, bool has_heights);

/// Writes a GLB file of the model with the maps inside, and the maps as PNG files with these texts.
/// Each file is written atomically.
Result<void> write_baked(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                         const Bake& bake, const PngTexts& texts);

}  // namespace cascade
