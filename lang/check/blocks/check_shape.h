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

/// Checks the shapes of a script and those of the library that it names: the sound ones, library
/// shapes first.
std::vector<ShapeForm> check_shapes(Workspace& work, const ast::Script& script, Sources& sources);

/// The same with these texts of the library.
std::vector<ShapeForm> checked_shapes(Workspace& work, const ast::Script& script,
                                      const std::vector<LibraryScript>& library);
/// The shape of a name; null if there is none. One of the script hides one of the library.
const ShapeForm* find_shape(const std::vector<ShapeForm>& shapes, std::string_view name);

}  // namespace cascade::checking
