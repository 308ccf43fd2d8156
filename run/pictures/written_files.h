// The results that the writers of models, cells and maps return.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct WrittenFiles {
    std::vector<std::filesystem::path> paths;
    std::vector<std::string> warnings = {};  ///< Each is a sentence.
    /// Advice for readers of the files. Each is a sentence.
    std::vector<std::string> notes = {};
};

}  // namespace cascade
