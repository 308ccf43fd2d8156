// The example scripts that come with Cascade.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct Example {
    /// The path below the folder of examples, without the ending: "cells/fur".
    std::string name;
    std::filesystem::path file;
    std::string text;
    std::string about;  ///< The first sentence of the script's first comment.
};

/// Reads all examples. They are sorted by name, and scripts in subfolders come last. Fails if the
/// program comes without examples.
Result<std::vector<Example>> read_examples();

/// Returns the example with this name. If there is none, returns all examples whose name is this
/// name after a folder, such as "cells/fur" for "fur".
std::vector<const Example*> examples_named(const std::vector<Example>& examples,
                                           std::string_view name);

/// Returns the files that the script of an example reads, relative to its folder.
std::vector<std::filesystem::path> files_read_by(const Example& example);

}  // namespace cascade
