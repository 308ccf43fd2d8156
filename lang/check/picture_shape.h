// The shape of the cells in pictures (spec/shapes.md).
#pragma once

#include "core/source.h"
#include "lang/program/shape_form.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The shape without a picture block that says another.
inline constexpr const char* usual_shape = "ball";

/// The shape that the picture block of a checked script names, else the usual one; of a file its
/// path. Adds nothing to `sources` that the check has not.
struct PictureShape {
    std::optional<ShapeForm> form;
    std::string path;     ///< As written; empty if there is a form.
    Span span;            ///< Where it was written; empty for the usual shape.
    double detail = 0.5;  ///< How far facets may be from the shape, in pixels.
};
PictureShape picture_shape(const ast::Script& script, Sources& sources);

/// A shape of the library.
ShapeForm library_shape(std::string_view name);

}  // namespace cascade
