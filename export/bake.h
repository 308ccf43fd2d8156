// Baking: paints the pattern of a surface into a texture that other programs map onto the model by
// its texture coordinates.
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
    std::int64_t width = 1024, height = 1024;  ///< In texels, 1 … largest_texture.
    int samples = 2;                           ///< samples × samples in each texel, 1 … 8.
    static constexpr std::int64_t largest_texture = 8192;
};

/// The baked maps. Their normals are relative to the tangents of render_vertices().
struct Bake : MaterialMaps {
    double covered = 0;  ///< Fraction of the samples that are on the surface.
    /// The fraction of the surface that is painted over by another part of the surface in the
    /// texture.
    double overlapping = 0;
    double shared = 0;  ///< Fraction of the samples that show several parts of the surface.
    std::vector<std::string> warnings;  ///< Each is one sentence.
};

/// The number of samples of the largest maps with the default number of samples per texel.
inline constexpr double most_samples =
    4.0 * BakeOptions::largest_texture * BakeOptions::largest_texture;

/// Checks that the model has texture coordinates suitable for baking maps of this many samples.
/// Fails, with a hint, if there are no coordinates, if the surface covers less of the texture than
/// one sample, or covers it many times over, as coordinates for repeating textures do.
Result<void> check_bakeable(const SurfaceMesh& mesh, double samples = most_samples);

/// Paints every texel with the mean, in linear light, of its samples on the surface. Extrapolates
/// to texels without samples. Texture coordinates outside 0 … 1 repeat the picture. Replaces
/// heights that are not finite by values from their surroundings. The result is the same with any
/// number of threads. It is undefined if `cancel` became true. Fails where check_bakeable fails,
/// and also if no sample is on the surface or memory runs out.
Result<Bake> bake(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel);
/// Does the same as bake() for samples that any painter paints. `painter` is called once in each
/// thread to make the thread's painter.
Result<Bake> bake(const SurfaceMesh& mesh, const MakeSamplePainter& painter,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
