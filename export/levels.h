// Levels of detail: coarser and coarser versions of a model with its colours and numbers, for
// greater and greater distances.
#pragma once

#include "core/result.h"
#include "export/model_writer.h"

#include <atomic>
#include <filesystem>
#include <span>
#include <vector>

namespace cascade {

/// From level to level, the number of triangles falls by about this factor.
inline constexpr std::size_t triangles_to_level = 4;

struct ModelLevel {
    SurfaceMesh mesh;
    std::vector<Colour> colours;
    std::vector<Channel> channels;

    PointResults results() const { return {colours, channels}; }
};

/// The finest level and coarser ones, each made from the previous one. `count` is the number of all
/// levels. There are fewer levels if no more triangles can be removed. The points of all levels are
/// points of the finest level. Triangles follow edges of the pattern, because the difference
/// between black and white counts as much as a distance of `pattern_length`. The colour (in linear
/// light) and the numbers of a point are the means, weighted by area, over the points that have
/// merged into it, so that details too small to be visible fade (G. Turk, "Texturing Surfaces Using
/// Reaction-Diffusion", thesis, 1992, section 5.4). Fails as simplify() does. Throws
/// std::bad_alloc. The result is meaningless if `cancel` became true.
Result<std::vector<ModelLevel>> levels_of(ModelLevel finest, int count, double pattern_length,
                                          const std::atomic<bool>& cancel);

/// The file of a level: "horse.ply" itself for level 0, "horse_lod1.ply" for level 1.
std::filesystem::path path_of_level(const std::filesystem::path& path, std::size_t level);

/// Writes each level to its own file by write_model(). In GLB format, the file of the finest level
/// also contains all other levels (encode_glb). Returns the files. Fails as write_model does.
Result<std::vector<std::filesystem::path>> write_levels(const std::filesystem::path& path,
                                                        std::span<const ModelLevel> levels);

}  // namespace cascade
