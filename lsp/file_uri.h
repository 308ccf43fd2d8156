// Addresses of files, such as file:///home/ada/spots%20a.cascade.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cascade::lsp {

/// The path in an address of the scheme `file`. Empty for addresses of other schemes or of other
/// machines, and for paths that are relative or contain NUL.
std::optional<std::filesystem::path> path_of_uri(std::string_view uri);
/// The address of a file. A relative path starts at the current folder.
std::string uri_of_path(const std::filesystem::path& path);

}  // namespace cascade::lsp
