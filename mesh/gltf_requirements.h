// What a glTF file asks of its reader, said before it is read.
#pragma once

#include "core/result.h"

#include <string_view>

namespace cascade {

/// Whether a JSON text is within the limits of memory and nesting that a parser needs.
Result<void> check_gltf_size(std::string_view json);

/// Fails on files of another version than 2, on extensions that a file requires and that are not
/// known, and on geometry that only a compressed form has; each is named. What is no JSON text
/// passes.
Result<void> check_gltf_requirements(std::string_view json);

/// Whether a file may use the extension without changing shapes, places, or coordinates in a way
/// that this reader leaves out.
bool is_known_extension(std::string_view name);

}  // namespace cascade
