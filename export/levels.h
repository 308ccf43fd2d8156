// Levels of detail: coarser and coarser versions of a model with its colours and numbers, for views
// from farther and farther away.
#pragma once

#include "core/result.h"
#include "export/model_writer.h"

#include <atomic>
#include <filesystem>
#include <span>
#include <vector>

namespace cascade {

/// Each level has about as many triangles as the previous one divided by this.
inline constexpr std::size_t triangles_to_level = 4;

struct ModelLevel {
    SurfaceMesh mesh;
    std::vector<Colour> colours;
    std::vector<Channel> channels;

    PointResults results() const { return {colours, channels}; }
};

/// The finest level and coarser ones, `count` in all, each made from the previous one. Fewer if no
/// more triangles can be removed. Their points are points of the finest one. Triangles follow edges
/// of the pattern: a difference of black and white counts as much as a distance of
/// `pattern_length`. Colours (in linear light) and numbers of a point are the means, weighted by
/// area, of the points that have merged into it, so that details too small to be seen fade (G.
/// Turk, "Texturing Surfaces Using Reaction-Diffusion", thesis, 1992, section 5.4). Fails as
/// simplify() does. Throws std::bad_alloc. Meaningless if `cancel` became true.
Result<std::vector<ModelLevel>> levels_of(ModelLevel finest, int count, double pattern_length,
                                          const std::atomic<bool>& cancel);

/// "horse.ply" itself for level 0, "horse_lod1.ply" for level 1.
std::filesystem::path path_of_level(const std::filesystem::path& path, std::size_t level);

/// Writes each level to a file of its own, as write_model does. A GLB file of the finest one
/// contains all of them (encode_glb). Returns the files. Fails as write_model does.
Result<std::vector<std::filesystem::path>> write_levels(const std::filesystem::path& path,
                                                        std::span<const ModelLevel> levels);

}  // namespace cascade
