// Models from files: PLY, OBJ, OFF, STL, glTF and GLB.
#pragma once

#include "core/granted_files.h"
#include "core/result.h"
#include "mesh/polygon_soup.h"

#include <filesystem>
#include <string_view>

namespace cascade {

/// The largest model file that is read, in bytes.
inline constexpr std::uint64_t largest_model_file = std::uint64_t{4} << 30;

/// Reads a model by the ending of its name, with the files that it names itself (buffers of glTF,
/// by paths relative to the model). Fails, naming the line or the place, on a file that is missing,
/// truncated or not of its format, on corners that are no points, and where there is no polygon at
/// all. Throws std::bad_alloc.
Result<PolygonSoup> read_model(const GrantedFiles& files, const std::string& name);

/// The same of a file that the user has named, wherever it lies. What it names must lie below its
/// own folder or those of `access`.
Result<PolygonSoup> read_model(const std::filesystem::path& path, const ReadAccess& access = {});

/// The same of the bytes of a file; `files` reads those that it names. `ending` is one of those of
/// its formats in lower case: "ply", "obj", "off", "stl", "gltf", "glb". A file without polygons is
/// no fault here.
Result<PolygonSoup> read_model_bytes(std::string_view bytes, std::string_view ending,
                                     const GrantedFiles& files = GrantedFiles::none());

// One format each; `bytes` is the whole file.

/// PLY, text or binary of either order, with polygons or triangle strips (mesh/ply_file.cpp).
Result<PolygonSoup> read_ply(std::string_view bytes);
/// OFF of text, with colours (mesh/off_file.cpp).
Result<PolygonSoup> read_off(std::string_view bytes);
/// OBJ, with texture coordinates and colours of points (mesh/obj_file.cpp).
Result<PolygonSoup> read_obj(std::string_view bytes);
/// STL, text or binary (mesh/stl_file.cpp).
Result<PolygonSoup> read_stl(std::string_view bytes);
/// glTF as text or binary by tinygltf (mesh/gltf_file.cpp); all meshes of the scene, placed by
/// its nodes. `files` reads buffers in files of their own.
Result<PolygonSoup> read_gltf(std::string_view bytes,
                              const GrantedFiles& files = GrantedFiles::none());

}  // namespace cascade
