// Reads models from files: PLY, OBJ, OFF, STL, glTF and GLB.
#pragma once

#include "core/granted_files.h"
#include "core/result.h"
#include "mesh/polygon_soup.h"

#include <filesystem>
#include <string_view>

namespace cascade {

/// The largest model file that is read, in bytes.
inline constexpr std::uint64_t largest_model_file = std::uint64_t{4} << 30;

/// Reads a model in the format of its extension, with the files that it refers to (buffers of glTF,
/// by paths relative to the model). Fails, with the line or position, if the file is missing,
/// truncated or malformed, and if there is no polygon. Throws std::bad_alloc.
Result<PolygonSoup> read_model(const GrantedFiles& files, const std::string& name);

/// Reads a model file named by the user, which may be anywhere. Files that the model refers to must
/// be below the model's folder or the folders of `access`.
Result<PolygonSoup> read_model(const std::filesystem::path& path, const ReadAccess& access = {});

/// Reads a model from bytes in memory. `files` reads the files that the model refers to. `ending`
/// is the format in lower case: "ply", "obj", "off", "stl", "gltf", "glb". Does not fail if the
/// model has no polygons.
Result<PolygonSoup> read_model_bytes(std::string_view bytes, std::string_view ending,
                                     const GrantedFiles& files = GrantedFiles::none());

// Each function below reads one format. `bytes` is the whole file.

/// PLY, text or binary of either byte order, with polygons or triangle strips (mesh/ply_file.cpp).
Result<PolygonSoup> read_ply(std::string_view bytes);
/// OFF as text, with colours (mesh/off_file.cpp).
Result<PolygonSoup> read_off(std::string_view bytes);
/// OBJ, with texture coordinates and colours of points (mesh/obj_file.cpp).
Result<PolygonSoup> read_obj(std::string_view bytes);
/// STL, text or binary (mesh/stl_file.cpp).
Result<PolygonSoup> read_stl(std::string_view bytes);
/// glTF 2.0 as text or binary, read by tinygltf (mesh/gltf_file.cpp): all meshes of the scene
/// (mesh/gltf_scene.h). `files` reads external buffers.
Result<PolygonSoup> read_gltf(std::string_view bytes,
                              const GrantedFiles& files = GrantedFiles::none());

}  // namespace cascade
