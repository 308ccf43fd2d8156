// GLB files: a model with vertex colours or with textures, for browsers, game engines and
// modellers. The format is defined in "glTF 2.0 Specification", Khronos Group, 2021.
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

/// The appearance of a model. All members are optional.
struct GlbLook {
    std::span<const Colour> colours;  ///< sRGB, one per point of the mesh.
    std::string_view colour_map;      ///< A PNG file; requires texture coordinates.
    /// A PNG file with directions relative to the tangents of render_vertices().
    std::string_view normal_map;
    std::string_view surface_map;   ///< A PNG file packed as MaterialMaps::surface.
    std::string_view emission_map;  ///< A PNG file of emitted colours.
    MapSet has;  ///< The parts that the maps contain. Opacity is the alpha channel of the colours.
    bool is_cut = false;  ///< Whether opacities only mark holes: an opacity below ½ is a hole.
    std::array<bool, 2> repeats{true, true};  ///< Whether the maps repeat along x and y.
    float roughness = 0.6F;                   ///< 0 … 1. Used if no map contains the roughness.
};

/// The bytes of the file. It has one mesh with smooth normals, and the texture coordinates and
/// tangents that the mesh has. Vertex colours (COLOR_0) are linear, as the format requires, with 16
/// bits. Surfaces with boundaries are double-sided. Positions are binary32. If binary32 cannot
/// represent them exactly, they are relative to the model's centre. Fails on models larger than
/// 10³⁰ or smaller than 10⁻³⁰, which binary32 cannot represent, and above 4 GiB.
Result<std::string> encode_glb(const SurfaceMesh& mesh, const GlbLook& look);

/// A moment of a model's growth, as numbers at the points of its mesh.
struct GlbMoment {
    std::vector<Colour> colours;  ///< sRGB.
    /// The positions of the points at that moment. If empty, the points are at the positions of the
    /// mesh.
    std::vector<Vector3d> points;
    double scale = 1;  ///< The size of the model at that moment, divided by its size at the end.
};

/// The history of a model.
struct GlbGrowth {
    std::span<const GlbMoment> moments;  ///< The moments before the final mesh, in order.
    double seconds = 0;                  ///< The time between two moments, above 0.
};

/// Does the same as encode_glb(), with an animation. Each moment is a morph target with the
/// differences of colours, positions and normals from the mesh. They change uniformly between two
/// moments. If a scale differs from 1, the animation also scales the model about the origin of its
/// coordinates. Programs that do not support colours of morph targets show the colours of the mesh.
/// Meshes with texture coordinates keep their tangents.
Result<std::string> encode_growing_glb(const SurfaceMesh& mesh, const GlbLook& look,
                                       const GlbGrowth& growth);

/// A level of detail of a model.
struct GlbLevel {
    const SurfaceMesh& mesh;
    const GlbLook& look;
};

/// Does the same as encode_glb() for a model and its coarser levels, finest first, by the extension
/// MSFT_lod. Programs without this extension show the first level. Programs with it show level k =
/// 0, 1, … if the model covers at least 4⁻¹⁻ᵏ of the screen, and the last level if the model is
/// smaller.
Result<std::string> encode_glb(std::span<const GlbLevel> levels);

}  // namespace cascade
