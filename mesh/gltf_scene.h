// The triangles of a glTF file's scene.
#pragma once

#include "core/result.h"
#include "mesh/gltf_model.h"
#include "mesh/polygon_soup.h"

namespace cascade {

/// All meshes of the scene, positioned by its nodes, by copies and by joints of skins. Shapes have
/// the default weights of their morph targets. `bytes` is the size of the file with its buffers,
/// which limits how often a file may use its data.
Result<PolygonSoup> read_gltf_scene(const tinygltf::Model& model, std::size_t bytes);

}  // namespace cascade
