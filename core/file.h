// Reading whole files and writing them atomically.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The content of a file. Fails for folders, for missing or unreadable files, and for files of more
/// than `largest` bytes. The size is checked before reading.
Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t largest);

/// The number of bytes of a file, if it exists and its size is known.
std::optional<std::uint64_t> size_of_file(const std::filesystem::path& path);

/// The first bytes of a file, at most `count`. Empty if the file cannot be opened, and for pipes
/// and devices, whose bytes can only be read once.
std::string first_bytes(const std::filesystem::path& path, std::size_t count);

/// The content of a regular file. Refuses symbolic links, pipes and devices, without waiting.
Result<std::string> read_plain_file(const std::filesystem::path& path, std::uint64_t largest);

/// Like read_plain_file, but follows symbolic links. Messages call the file `name`, or `path` if
/// that is empty.
Result<std::string> read_linked_file(const std::filesystem::path& path, std::uint64_t largest,
                                     std::string_view name = "");

/// Like read_plain_file, for a file below `folder`. The path `file` is relative, has no "..", and
/// no part of it may be a symbolic link. Opens nothing outside the folder, even if names change
/// meanwhile.
Result<std::string> read_file_below(const std::filesystem::path& folder,
                                    const std::filesystem::path& file, std::uint64_t largest,
                                    std::string_view name);

/// Writes a temporary file in the same folder and renames it over the target, so that no reader
/// sees a half-written file. On failure, such as a full disk, the temporary file is removed.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Creates a folder and its missing parents.
Result<void> make_folder(const std::filesystem::path& folder);

/// Checks that a file can be written at `path`: the folder exists and is writable, and `path` is no
/// folder. Leaves no file.
Result<void> check_writable(const std::filesystem::path& path);

}  // namespace cascade
