// Finds the shape of cells in pictures (spec/shapes.md).
#pragma once

#include "core/source.h"
#include "lang/program/shape_form.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The shape of cells if the picture block does not name a shape.
inline constexpr const char* usual_shape = "ball";

/// The shape that the picture block of a checked script names or, if it names none, the usual
/// shape. If the picture block names a file, only the path of the file is given.
struct PictureShape {
    std::optional<ShapeForm> form;
    std::string path;  ///< The path of the file as the script gives it. Empty if `form` is given.
    Span span;         ///< Where the name is in the script; empty for the usual shape.
    double detail = 0.5;  ///< The largest deviation of facets from the shape, in pixels.
};
PictureShape picture_shape(const ast::Script& script, Sources& sources);

/// The library shape with this name.
ShapeForm library_shape(std::string_view name);

}  // namespace cascade
