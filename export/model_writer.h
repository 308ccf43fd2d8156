// Writes models with results as files for other programs: PLY, OBJ, GLB, VTK's .vtp and STL.
#pragma once

#include "core/result.h"
#include "export/channels.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The data to write in addition to the shape.
struct PointResults {
    std::span<const Colour> colours;    ///< sRGB, one per point of the mesh. May be empty.
    std::span<const Channel> channels;  ///< Each has one number per point.
};

/// Binary PLY (G. Turk, "The PLY Polygon File Format", 1994). Each point has its position (as
/// `float`, or as `double` if `float` would not be exact), its normal, its colour as 8-bit `red
/// green blue`, and each channel as a `float` of its name. Each triangle has its corners and, if
/// the mesh has them, texture coordinates as `texcoord`. Channel names that mean something else to
/// readers, such as `u`, get an underscore.
std::string encode_ply(const SurfaceMesh& mesh, const PointResults& results);

/// Wavefront OBJ as text. Colours follow the position in `v`, as MeshLab and Blender read them.
/// Numbers have the fewest digits that read back exactly. The format has no place for channels.
std::string encode_obj(const SurfaceMesh& mesh, const PointResults& results);

/// VTK's XML PolyData with one appended raw block (The VTK User's Guide, 11th edition, Kitware
/// 2010, chapter 19): triangles and, as point data, normals, colours as `color`, and the channels.
std::string encode_vtp(const SurfaceMesh& mesh, const PointResults& results);

/// Binary STL: triangles with their normals in binary32, relative to the origin, without shared
/// points, colours or channels.
std::string encode_stl(const SurfaceMesh& mesh, Vector3d origin = {});
/// The origin for encode_stl(): 0, or the model's middle if the model is so far from 0 that
/// binary32 would blur its triangles.
Vector3d stl_origin(const SurfaceMesh& mesh);

/// The origin of the coordinates in a file of this name: 0 except for STL.
Vector3d origin_of_file(const std::filesystem::path& path, const SurfaceMesh& mesh);
/// A sentence for the user that gives the origin. Empty if the origin is 0.
std::vector<std::string> remarks_of_origin(const std::filesystem::path& path, Vector3d origin);

/// Writes a file atomically, in the format of its extension: .ply, .obj, .glb, .vtp or .stl, in
/// upper or lower case. NaN stays NaN in channels and is magenta in colours. Fails on other
/// extensions, on models that the format cannot represent (see export/glb.h), and as write_file
/// does. `origin` replaces origin_of_file(), for levels of a model, which share one origin.
Result<void> write_model(const std::filesystem::path& path, const SurfaceMesh& mesh,
                         const PointResults& results, std::optional<Vector3d> origin = {});

}  // namespace cascade
