// GLB files: a model with colours at its points or with pictures laid over it, as browsers, game
// engines and modellers open it. The format: "glTF 2.0 Specification", Khronos Group, 2021.
#pragma once

#include "core/palette.h"
#include "core/result.h"
#include "export/render_vertices.h"

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// What a model looks like; all of it may be left out.
struct GlbLook {
    std::span<const Colour> colours;  ///< sRGB, one per point of the mesh.
    std::string_view colour_map;      ///< A PNG file; it takes texture coordinates.
    std::string_view normal_map;      ///< Likewise, relative to the tangents of render_vertices().
    float roughness = 0.6F;           ///< 0 … 1, the same everywhere. Nothing is metal.
};

/// The file in memory: one mesh, its normals smooth, with the texture coordinates and tangents that
/// the mesh has. Colours of points (COLOR_0) are amounts of light, as the format wants them, of 16
/// bits. A surface with boundaries is seen from both sides. Places are binary32, around the middle
/// of the model where they are not exact otherwise. Fails on a model larger than 10³⁰ or smaller
/// than 10⁻³⁰, which binary32 does not hold, and on more than 4 GiB.
Result<std::string> encode_glb(const SurfaceMesh& mesh, const GlbLook& look);

}  // namespace cascade
