// Reports of the writers of models, cells and maps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct WrittenFiles {
    std::vector<std::filesystem::path> paths;
    std::vector<std::string> warnings;  ///< A sentence each.
};

}  // namespace cascade
