// The maps of a material: textures, and the files that hold them.
#pragma once

#include "core/result.h"
#include "export/material.h"
#include "mesh/surface_mesh.h"
#include "picture/image.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace cascade {

/// Textures of one size. Missing ones are empty.
struct MaterialMaps {
    Image colour;
    /// Grey, from 0 to 1 over the range of the texels' heights, `heights`.
    Image relief;
    ValueRange heights;
    /// Directions relative to the tangents, −1 … 1 stored as 0 … 1, y up.
    Image normals;
    /// Red is occlusion, green roughness and blue metalness, as glTF packs them. 1 if `maps` lacks
    /// the part.
    Image surface;
    Image emission;
    Image opacity;  ///< Grey.
    MapSet maps;
    bool is_cut = false;  ///< Opacities mark holes: 0 or 1, and between only at their edges.
    /// Along x and y: the texture repeats. Otherwise its edge texels extend outwards.
    std::array<bool, 2> repeats{true, true};
};

/// The format of maps next to a model: PNG, or OpenEXR with linear colours and heights in lengths.
enum class MapFormat : std::uint8_t { png, exr };

/// The files that write_maps makes: the model, then in the same folder NAME_color.png and one for
/// each of the other maps: NAME_height.png and NAME_normal.png (16 bits), NAME_occlusion.png,
/// NAME_roughness.png, NAME_metalness.png, NAME_emission.png, NAME_opacity.png; or .exr.
std::vector<std::filesystem::path> map_paths(const std::filesystem::path& glb, const MapSet& maps,
                                             MapFormat format = MapFormat::png);

/// A model with texture coordinates, or one of its levels of detail.
struct MappedModel {
    const SurfaceMesh& mesh;
    const MaterialMaps& maps;
};

/// Writes a GLB file of the model with the maps inside, and the maps next to it. PNG files have
/// these texts. Coarser levels follow the model, finest first, and only have their maps inside
/// (encode_glb). Each file is written atomically.
Result<void> write_maps(const std::filesystem::path& glb, std::span<const MappedModel> levels,
                        const PngTexts& texts, MapFormat format = MapFormat::png);
/// The same for the model alone.
Result<void> write_maps(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                        const MaterialMaps& maps, const PngTexts& texts,
                        MapFormat format = MapFormat::png);

}  // namespace cascade
