// Models with what grew on them, as files for other programs: PLY, OBJ, GLB and VTK's .vtp.
#pragma once

#include "core/result.h"
#include "export/channels.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// What a file shows of a mesh, beside its shape.
struct PointResults {
    std::span<const Colour> colours;    ///< sRGB, one per point of the mesh; empty: none.
    std::span<const Channel> channels;  ///< One number per point each.
};

/// Binary PLY (G. Turk, "The PLY Polygon File Format", 1994): per point its place (`float`, or
/// `double` where that is not exact), normal, colour as 8-bit `red green blue`, and each channel as
/// a `float` of its name; per triangle its corners and, where the mesh has them, texture
/// coordinates as `texcoord`. Names that readers take for something else, such as `u`, have an
/// underscore added.
std::string encode_ply(const SurfaceMesh& mesh, const PointResults& results);

/// Wavefront OBJ as text: colours follow the place in `v`, as MeshLab and Blender read them.
/// Numbers are the shortest that give the same number when read. It has no place for channels.
std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results);

/// VTK's XML PolyData with one appended raw block (The VTK User's Guide, 11th edition, Kitware
/// 2010, chapter 19): triangles, normals, colours as `color` and each channel as point data.
std::string encode_vtp(const SurfaceMesh& mesh, const PointResults& results);

/// Writes by the ending of the name, .ply, .obj, .glb or .vtp, in upper or lower case, atomically.
/// A NaN of a channel is a NaN in the file, a colour that is none is magenta. Fails on another
/// ending, on what the format cannot hold (see export/glb.h), and as write_file does.
Result<void> write_model(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const PointResults& results);

/// Whether write_model knows the ending.
bool is_model_ending(const std::filesystem::path& path);

}  // namespace cascade
