// Builds the text of a Wavefront OBJ file, object after object.
#pragma once

#include "export/instanced_model.h"
#include "export/model_writer.h"

#include <string>
#include <string_view>

namespace cascade {

class ObjText {
public:
    /// Begins an object with a name.
    void begin(std::string_view name);
    void add(const SurfaceMesh& mesh, const PointResults& results);
    /// Adds copies. Coordinates have nine digits, or more if they are far from the origin.
    void add(const MergedCopies& copies);

    const std::string& text() const { return text_; }

private:
    std::string text_ = "# Cascade\n";
    // The numbers of items written so far. Indices in a file begin at 1 and continue from object to
    // object.
    std::size_t points_ = 0, normals_ = 0, places_ = 0;
};

}  // namespace cascade
