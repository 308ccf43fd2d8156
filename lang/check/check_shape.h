// Checks `shape` blocks (spec/shapes.md) and finds that of the picture.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/shape_form.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <vector>

namespace cascade {

namespace checking {

struct Workspace;

/// Checks the shapes of a script and those of the library that it names: the sound ones, library
/// shapes first.
std::vector<ShapeForm> check_shapes(Workspace& work, const ast::Script& script, Sources& sources);

/// The shape of a name; null if there is none. One of the script hides one of the library.
const ShapeForm* find_shape(const std::vector<ShapeForm>& shapes, std::string_view name);

/// Reports that there is no shape of this name.
void report_unknown_shape(Workspace& work, const ast::Script& script, const ast::Word& name);

}  // namespace checking

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
