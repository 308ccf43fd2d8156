// A file that is written piece by piece and gets its name when it is complete.
#pragma once

#include "core/result.h"
#include "core/temporary_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace cascade {

/// A file that grows under a temporary name in the folder of its target. If destroyed before
/// complete() or appear(), it leaves no new file and does not change a file that has the target's
/// name.
class GrowingFile {
public:
    /// Begins an empty file. Fails in the same cases as write_file, and also if `path` is a pipe or
    /// a device, whose bytes cannot be overwritten later.
    static Result<std::unique_ptr<GrowingFile>> create(const std::filesystem::path& path);

    /// Adds bytes at the end. If this fails, the file is unchanged.
    Result<void> append(std::string_view bytes);
    /// Replaces everything from byte `place` on. If this fails, the file is unchanged.
    Result<void> replace_end(std::uint64_t place, std::string_view bytes);
    /// Replaces bytes written earlier, from byte `place` on.
    Result<void> overwrite(std::uint64_t place, std::string_view bytes);
    /// Gives the file its final name now, before complete(). Serves formats whose files can be read
    /// at any moment while they grow.
    Result<void> appear();
    /// The number of bytes.
    std::uint64_t size() const { return size_; }
    /// The temporary path of the file, so that another program can write to the file before
    /// complete().
    std::filesystem::path temporary_path() const;

    /// Syncs the file to the disk and gives it its final name. Must be the last call.
    Result<void> complete();

private:
    GrowingFile(const std::filesystem::path& path, const std::filesystem::path& target);

    std::filesystem::path path_;    ///< The path as the user wrote it.
    std::filesystem::path target_;  ///< The path with links resolved.
    Descriptor folder_;
    std::optional<TemporaryFile> file_;
    std::uint64_t size_ = 0;
    bool has_appeared_ = false;
};

/// Fails if something other than a regular file has this name, because only regular files can grow.
Result<void> check_can_grow(const std::filesystem::path& path);

}  // namespace cascade
