// Files: whole reads and atomic writes with clear reasons for failure.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The whole file. Fails on a directory, a missing or unreadable file, one above `largest` bytes
/// (the size is looked at before reading).
Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t largest);

/// The first bytes of a file, at most `count`. Nothing of what cannot be opened and of pipes and
/// devices, which give their bytes once.
std::string first_bytes(const std::filesystem::path& path, std::size_t count);

/// The whole of what is a file itself: links, pipes and devices are refused, without waiting.
Result<std::string> read_plain_file(const std::filesystem::path& path, std::uint64_t largest);

/// The same with links followed. Messages call the file `name`; empty: as in `path`.
Result<std::string> read_linked_file(const std::filesystem::path& path, std::uint64_t largest,
                                     std::string_view name = "");

/// The same of a file below `folder`. `file` is relative, has no "..", and no part of it may be a
/// symbolic link: nothing outside of the folder is opened, whatever happens to names meanwhile.
Result<std::string> read_file_below(const std::filesystem::path& folder,
                                    const std::filesystem::path& file, std::uint64_t largest,
                                    std::string_view name);

/// Writes beside the target and renames over it, so that no half-written file is ever seen; the
/// temporary file is removed on failure. A full disk is a Failure.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it, where they are missing.
Result<void> make_folder(const std::filesystem::path& folder);

/// Can a file of this path be written? Looks without leaving anything behind: the folder exists and
/// is writable, the path is no directory.
Result<void> check_writable(const std::filesystem::path& path);

}  // namespace cascade
