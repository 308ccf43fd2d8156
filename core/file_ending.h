// What a file is called at the end.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace cascade {

/// The extension of a file's name with its letters A to Z in lower case, such as ".glb".
inline std::string lower_ending(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return ending;
}

}  // namespace cascade
