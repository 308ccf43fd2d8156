// Models with results, as files for other programs: PLY, OBJ, GLB, VTK's .vtp and STL.
#pragma once

#include "core/result.h"
#include "export/channels.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The data of a file besides the shape.
struct PointResults {
    std::span<const Colour> colours;    ///< sRGB, one per point of the mesh; empty: none.
    std::span<const Channel> channels;  ///< One number per point each.
};

/// Binary PLY (G. Turk, "The PLY Polygon File Format", 1994). Per point: position (`float`, or
/// `double` if that is not exact), normal, colour as 8-bit `red green blue`, and each channel as a
/// `float` of its name. Per triangle: its corners and, if the mesh has them, texture coordinates as
/// `texcoord`. Names with another meaning to readers, such as `u`, get an underscore.
std::string encode_ply(const SurfaceMesh& mesh, const PointResults& results);

/// Wavefront OBJ as text. Colours follow the position in `v`, as MeshLab and Blender read them.
/// Numbers are the shortest that read back exactly. Channels cannot be represented.
std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results);

/// VTK's XML PolyData with one appended raw block (The VTK User's Guide, 11th edition, Kitware
/// 2010, chapter 19): triangles, normals, colours as `color` and each channel as point data.
std::string encode_vtp(const SurfaceMesh& mesh, const PointResults& results);

/// Binary STL: triangles with their normals in binary32, relative to the origin, without shared
/// points, colours or channels.
std::string encode_stl(const SurfaceMesh& mesh, Vector3d origin = {});
/// 0, or the model's middle if it is so far away that binary32 would blur its triangles.
Vector3d stl_origin(const SurfaceMesh& mesh);

/// The origin of the coordinates in this file of the model: 0 except for STL.
Vector3d origin_of_file(const std::filesystem::path& path, const SurfaceMesh& mesh);
/// Says so in a sentence; none if it is 0.
std::vector<std::string> remarks_of_origin(const std::filesystem::path& path, Vector3d origin);

/// Writes the format of the name's extension, .ply, .obj, .glb, .vtp or .stl in any case,
/// atomically. NaN stays NaN in channels and is magenta in colours. Fails on other extensions, on
/// models that the format cannot represent (see export/glb.h), and as write_file does. An origin
/// other than origin_of_file() is for levels of a model, which share one.
Result<void> write_model(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const PointResults& results, std::optional<Vector3d> origin = {});

}  // namespace cascade
