// Shapes of cells from the files of models.
#pragma once

#include "core/result.h"
#include "mesh/triangle_mesh.h"
#include "run/script/script.h"

#include <string>

namespace cascade {

/// A model as a shape: moved and stretched so that it reaches from −1 to 1 in x and z, and from 0
/// to 1 in y, which points upwards in the file. Flat directions remain flat.
struct FileShape {
    TriangleMesh mesh;
    double length = 1, height = 1;  ///< The model's, as multiples of its width.
};

/// Fails if the script may not read the file, and as read_model() and make_mesh() do. Throws
/// std::bad_alloc.
Result<FileShape> read_shape(const Script& script, const std::string& path);

}  // namespace cascade
