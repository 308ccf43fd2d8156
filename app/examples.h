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
    std::string name;  ///< Its path below the folder of examples without ending: "cells/fur".
    std::filesystem::path file;
    std::string text;
    std::string about;  ///< The first sentence of its first comment.
};

/// All examples, sorted by name. Scripts in subfolders come last. Fails if the program comes
/// without examples.
Result<std::vector<Example>> read_examples();

/// The example with this name, or else all examples whose name has this last part ("fur").
std::vector<const Example*> examples_named(const std::vector<Example>& examples,
                                           std::string_view name);

/// The files that the script of an example reads, relative to its folder.
std::vector<std::filesystem::path> files_read_by(const Example& example);

}  // namespace cascade
