// Writes scales, thorns or hairs on a body as files for other programs.
#pragma once

#include "core/palette.h"
#include "core/result.h"
#include "mesh/instances.h"
#include "mesh/surface_mesh.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The model to write. Refers to its parts, which must outlive it.
struct InstancedModel {
    const SurfaceMesh* body = nullptr;  ///< May be null.
    std::span<const Colour> colours;    ///< Colours of the body: sRGB, one per point. May be empty.
    const Instances& copies;            ///< May be empty if there is a body.
};

/// A GLB file that stores each mesh once, by the extension EXT_mesh_gpu_instancing (Khronos Group,
/// 2020), which readers must support. Copies have translations and scales in binary32, rotations as
/// 16-bit fractions, whose errors are below 0.003 degrees, and colours.
///
/// The extension does not define colours. Some programs (three.js, Babylon.js) read them from the
/// attribute `_COLOR_0`, linear light by which they multiply the material's colour. For all other
/// programs, copies of similar colours share one of at most `most_copy_materials` materials, which
/// has their mean colour. `_COLOR_0` is a copy's light divided by its material's light. So programs
/// that read `_COLOR_0` show each colour exactly. Other programs show approximate colours, or exact
/// ones if there are at most `most_copy_materials` colours.
Result<std::string> encode_instanced_glb(const InstancedModel& model);
inline constexpr std::size_t most_copy_materials = 32;

/// The largest number of triangles of merged copies.
inline constexpr std::uint64_t most_merged_triangles = std::uint64_t{1} << 24;

/// All copies as plain triangles, for programs that do not support instances.
struct MergedCopies {
    std::vector<Vector3d> points;
    std::vector<Vector3> normals;  ///< One per point. `colours` has one per point, too.
    std::vector<Colour> colours;   ///< sRGB, darkened by the shades.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Merges all copies. Fails if they have more than `most_merged_triangles`.
Result<MergedCopies> merge_copies(const Instances& copies);

/// A GLB file of plain triangles with vertex colours. It has a node for the body and one for the
/// copies. Fails as merge_copies() does.
Result<std::string> encode_merged_glb(const InstancedModel& model);

/// A Wavefront OBJ file of plain triangles. It has an object `body` and an object `copies`, with
/// colours after the positions. Coordinates of copies have nine digits, or more if they are far
/// from the origin. Fails as merge_copies() does.
Result<std::string> encode_merged_obj(const InstancedModel& model);

/// Writes a .glb or .obj file atomically. OBJ files are always merged. Fails on other extensions,
/// if there are no triangles at all, and as the encoders and write_file do.
Result<void> write_instanced(const std::filesystem::path& path, const InstancedModel& model,
                             bool is_merged);

}  // namespace cascade
