// Finds the shape of cells in pictures (spec/shapes.md).
#pragma once

#include "core/source.h"
#include "lang/program/shape_form.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The shape of cells if the picture block names none.
inline constexpr const char* usual_shape = "ball";

/// The shape that the picture block of a checked script names, or the usual shape. If the picture
/// block names a file, only its path is given.
struct PictureShape {
    std::optional<ShapeForm> form;
    std::string path;     ///< The path of the file as it is written. Empty if `form` is given.
    Span span;            ///< The place of the name in the script; empty for the usual shape.
    double detail = 0.5;  ///< The greatest deviation of facets from the shape, in pixels.
};
PictureShape picture_shape(const ast::Script& script, Sources& sources);

/// The shape of this name in the library.
ShapeForm library_shape(std::string_view name);

}  // namespace cascade
