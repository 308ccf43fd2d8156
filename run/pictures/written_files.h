// Reports of the writers of models, cells and maps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct WrittenFiles {
    std::vector<std::filesystem::path> paths;
    std::vector<std::string> warnings = {};  ///< A sentence each.
    std::vector<std::string> notes = {};     ///< What readers of the files need to know, likewise.
};

}  // namespace cascade
