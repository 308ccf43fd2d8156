// GLB files: a model with vertex colours or with textures, for browsers, game engines and
// modellers. The format is "glTF 2.0 Specification", Khronos Group, 2021.
#pragma once

#include "core/palette.h"
#include "core/result.h"
#include "export/material.h"
#include "export/render_vertices.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The appearance of a model. All of it is optional.
struct GlbLook {
    std::span<const Colour> colours;  ///< sRGB, one per point of the mesh.
    std::string_view colour_map;      ///< A PNG file; requires texture coordinates.
    std::string_view normal_map;      ///< Likewise, relative to the tangents of render_vertices().
    std::string_view surface_map;     ///< Likewise, packed as in MaterialMaps.
    std::string_view emission_map;    ///< Likewise.
    MapSet has;                       ///< Parts in the maps. Opacity is in the colours.
    bool is_cut = false;              ///< Opacities only mark holes, below ½.
    std::array<bool, 2> repeats{true, true};  ///< Along x and y.
    float roughness = 0.6F;                   ///< 0 … 1, if no map has it.
};

/// The file in memory: one mesh with smooth normals, and the texture coordinates and tangents that
/// the mesh has. Vertex colours (COLOR_0) are linear, as the format requires, with 16 bits.
/// Surfaces with boundaries are double-sided. Positions are binary32, relative to the model's
/// centre if they would not be exact otherwise. Fails on models larger than 10³⁰ or smaller than
/// 10⁻³⁰, which binary32 cannot represent, and above 4 GiB.
Result<std::string> encode_glb(const SurfaceMesh& mesh, const GlbLook& look);

/// A moment of the growth of a model: numbers at the points of its mesh.
struct GlbMoment {
    std::vector<Colour> colours;   ///< sRGB.
    std::vector<Vector3d> points;  ///< Their positions; empty: the mesh's.
};

/// The history of a model.
struct GlbGrowth {
    std::span<const GlbMoment> moments;  ///< Earlier than the mesh, in order.
    double seconds = 0;                  ///< Between two moments, above 0.
};

/// The same with an animation: each moment is a morph target, with the differences of colours,
/// positions and normals, which change uniformly between two moments. Programs without colours of
/// morph targets show the mesh as it is. Meshes with texture coordinates keep their tangents.
Result<std::string> encode_growing_glb(const SurfaceMesh& mesh, const GlbLook& look,
                                       const GlbGrowth& growth);

/// A level of detail of a model.
struct GlbLevel {
    const SurfaceMesh& mesh;
    const GlbLook& look;
};

/// The same for a model and its coarser levels, finest first, by the extension MSFT_lod. Programs
/// that do not know it show the first one. The others show level k = 0, 1, … if the model covers at
/// least 4⁻¹⁻ᵏ of the screen, and the last level if it is smaller.
Result<std::string> encode_glb(std::span<const GlbLevel> levels);

}  // namespace cascade
