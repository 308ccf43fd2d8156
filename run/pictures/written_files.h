// The results that the writers of models, cells and maps return.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct WrittenFiles {
    std::vector<std::filesystem::path> paths;
    std::vector<std::string> warnings = {};  ///< Each warning is a sentence.
    /// Advice for users of the files. Each note is a sentence.
    std::vector<std::string> notes = {};
};

}  // namespace cascade
