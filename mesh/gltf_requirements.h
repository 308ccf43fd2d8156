// The requirements of a glTF file, checked before it is read.
#pragma once

#include "core/result.h"

#include <string_view>

namespace cascade {

/// Whether a JSON text is within the limits of memory and nesting that a parser needs.
Result<void> check_gltf_size(std::string_view json);

/// Fails on files of another version than 2, on required extensions that are unknown, and on
/// geometry that exists only in a compressed form. Names each. Accepts any text that is not JSON.
Result<void> check_gltf_requirements(std::string_view json);

/// Whether the reader can ignore or apply the extension without an error in shapes, positions, or
/// texture coordinates.
bool is_known_extension(std::string_view name);

}  // namespace cascade
