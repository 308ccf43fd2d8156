// Checks `shape` blocks (spec/shapes.md; internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/library/library.h"
#include "lang/program/shape_form.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

struct Workspace;

/// Checks the shapes of a script and the library shapes that the script names. Returns the shapes
/// without errors, library shapes first.
std::vector<ShapeForm> check_shapes(Workspace& work, const ast::Script& script, Sources& sources);

/// Checks the shapes of a script and the shapes in `library`. Returns the shapes without errors.
std::vector<ShapeForm> checked_shapes(Workspace& work, const ast::Script& script,
                                      const std::vector<LibraryScript>& library);
/// The shape with this name; null if there is none. If a shape of the script and a library shape
/// have the same name, the result is the shape of the script.
const ShapeForm* find_shape(const std::vector<ShapeForm>& shapes, std::string_view name);

}  // namespace cascade::checking
