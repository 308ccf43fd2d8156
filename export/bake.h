// Baking: painting the pattern of a surface into a texture that other programs map onto the model
// by its texture coordinates.
#pragma once

#include "core/result.h"
#include "export/material_maps.h"
#include "export/painted_cells.h"
#include "export/sample_painter.h"

#include <atomic>
#include <string>
#include <vector>

namespace cascade {

struct BakeOptions {
    std::int64_t width = 1024, height = 1024;  ///< Texels, 1 … largest_texture.
    int samples = 2;                           ///< samples × samples in each texel, 1 … 8.
    static constexpr std::int64_t largest_texture = 8192;
};

/// Normals are relative to the tangents of render_vertices().
struct Bake : MaterialMaps {
    double covered = 0;      ///< Fraction of the samples on the surface.
    double overlapping = 0;  ///< Fraction of the surface covered by another part in the texture.
    double shared = 0;       ///< Fraction of the samples on several parts of the surface.
    std::vector<std::string> warnings;  ///< One sentence each.
};

/// For the largest maps.
inline constexpr double most_samples =
    4.0 * BakeOptions::largest_texture * BakeOptions::largest_texture;

/// Checks that the model has texture coordinates suitable for baking maps of this many samples, or
/// the largest ones. Fails, with a hint, if it has none, if they cover less than a sample, or if
/// they cover the texture many times, as coordinates for repeating textures do.
Result<void> check_bakeable(const SurfaceMesh& mesh, double samples = most_samples);

/// Paints every texel with the mean, in linear light, of its samples on the surface, and
/// extrapolates to texels without samples. Texture coordinates outside 0 … 1 repeat the picture.
/// Non-finite heights are replaced from their surroundings. The result is the same on any number of
/// threads, and undefined if `cancel` became true. Fails where check_bakeable does, and also if no
/// sample is on the surface or memory runs out.
Result<Bake> bake(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel);
/// The same with painters, of which each thread has one.
Result<Bake> bake(const SurfaceMesh& mesh, const MakeSamplePainter& painter,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
