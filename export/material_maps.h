// The maps of a material, and the files that hold them.
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

/// Textures of one size. Missing maps are empty.
struct MaterialMaps {
    Image colour;
    /// The heights of the texels as greys from 0 to 1, which stand for the lowest and the highest
    /// value in the range `heights`.
    Image relief;
    ValueRange heights;
    /// Directions relative to the tangents, with y upwards. Components from −1 to 1 are stored as 0
    /// to 1.
    Image normals;
    /// Occlusion in red, roughness in green and metalness in blue, as in glTF. A channel is 1 if
    /// `maps` does not contain its part.
    Image surface;
    Image emission;
    Image opacity;  ///< Grey.
    MapSet maps;
    /// Whether opacities only mark holes. They are then 0 or 1, except at the edges of holes.
    bool is_cut = false;
    /// Whether the textures repeat along x and y. If not, edge texels extend outwards.
    std::array<bool, 2> repeats{true, true};
};

/// The format of the map files that are written next to a model: PNG, or OpenEXR. In OpenEXR,
/// colours are linear, and heights are lengths.
enum class MapFormat : std::uint8_t { png, exr };

/// The files that write_maps() makes: the model, then in the same folder NAME_color.png, and one
/// file for each further map that exists: NAME_height.png and NAME_normal.png (16 bits),
/// NAME_occlusion.png, NAME_roughness.png, NAME_metalness.png, NAME_emission.png, NAME_opacity.png.
/// In OpenEXR, the ending is .exr.
std::vector<std::filesystem::path> map_paths(const std::filesystem::path& glb, const MapSet& maps,
                                             MapFormat format = MapFormat::png);

/// A model with texture coordinates, or one of its levels of detail.
struct MappedModel {
    const SurfaceMesh& mesh;
    const MaterialMaps& maps;
};

/// Writes a GLB file of the model with the maps inside, and the maps next to it. `texts` are stored
/// in PNG files. `levels` begins with the model. Coarser levels follow, finest first. Their maps
/// are only inside the GLB file (encode_glb). Each file is written atomically.
Result<void> write_maps(const std::filesystem::path& glb, std::span<const MappedModel> levels,
                        const PngTexts& texts, MapFormat format = MapFormat::png);
/// Does the same as write_maps() for a model without coarser levels.
Result<void> write_maps(const std::filesystem::path& glb, const SurfaceMesh& mesh,
                        const MaterialMaps& maps, const PngTexts& texts,
                        MapFormat format = MapFormat::png);

}  // namespace cascade
