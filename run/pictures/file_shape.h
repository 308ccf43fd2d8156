// Reads the shapes of cells from the files of models.
#pragma once

#include "core/result.h"
#include "mesh/triangle_mesh.h"
#include "run/script/script.h"

#include <string>

namespace cascade {

/// A model as the shape of cells. It is moved and stretched so that it reaches from −1 to 1 in x
/// and z, and from 0 to 1 in y, which points upwards. If a model has no extent along an axis, it
/// gets none.
struct FileShape {
    TriangleMesh mesh;
    /// The length and height of the model before stretching, as multiples of its width.
    double length = 1, height = 1;
};

/// Fails if the script may not read the file, and in the same cases as read_model() and
/// make_mesh(). Throws std::bad_alloc.
Result<FileShape> read_shape(const Script& script, const std::string& path);

}  // namespace cascade
