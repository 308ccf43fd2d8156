// A file that is written piece by piece, and takes its name when it is complete.
#pragma once

#include "core/result.h"
#include "core/temporary_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace cascade {

/// Grows under a temporary name in the folder of its target. Destroyed before complete(), it leaves
/// nothing, and a file that already has the name stays as it is.
class GrowingFile {
public:
    /// Begins an empty file. Fails as write_file does, and if `path` is a pipe or a device, where
    /// nothing can be overwritten later.
    static Result<std::unique_ptr<GrowingFile>> create(const std::filesystem::path& path);

    /// Adds bytes at the end.
    Result<void> append(std::string_view bytes);
    /// Replaces bytes that were written before, beginning with byte `place`.
    Result<void> overwrite(std::uint64_t place, std::string_view bytes);
    /// The number of bytes that were appended.
    std::uint64_t size() const { return size_; }
    /// Where the bytes are until it is complete, for another program that writes them.
    std::filesystem::path temporary_path() const;

    /// Moves the file to its name, once it is on the disk. Nothing may follow.
    Result<void> complete();

private:
    GrowingFile(const std::filesystem::path& path, const std::filesystem::path& target);

    std::filesystem::path path_;    ///< As the user wrote it.
    std::filesystem::path target_;  ///< Behind links.
    Descriptor folder_;
    std::optional<TemporaryFile> file_;
    std::uint64_t size_ = 0;
};

/// Fails if something other than a regular file has this name: only those can grow.
Result<void> check_can_grow(const std::filesystem::path& path);

}  // namespace cascade
