// The requirements of a glTF file, checked before it is read.
#pragma once

#include "core/result.h"

#include <string_view>

namespace cascade {

/// Fails if a JSON text exceeds the limits of memory and nesting for parsing.
Result<void> check_gltf_size(std::string_view json);

/// Fails on files of another version than 2, on required extensions that are unknown, and on
/// geometry that exists only in a compressed form. The message names the cause. Does not fail on
/// text that is not JSON.
Result<void> check_gltf_requirements(std::string_view json);

/// Whether the reader applies the extension, or can ignore it without an error in shapes, positions
/// or texture coordinates.
bool is_known_extension(std::string_view name);

}  // namespace cascade
