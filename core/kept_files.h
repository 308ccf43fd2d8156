// Small files stored on disk under keys for later processes: compiled kernels and measurements.
//
// A folder has one file per key. If anything is wrong with a file, its owner or the folder, the key
// counts as unknown, so such a problem never makes a run fail. Processes may share the folder,
// because a file gets its name only when it is complete. A file holds the whole key, so that a hash
// collision does no harm, and a checksum of everything. The checksum guards against accidents only.
// As protection against other users, files and folder must belong to this user and be writable by
// no one else.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

class Descriptor;

class KeptFiles {
public:
    /// The properties shared by all files of one kind. Several kinds may share a folder.
    struct Kind {
        std::string_view suffix;  ///< The ending of all names of these files, such as ".kernel".
        /// The first eight bytes of each file. The last of these bytes is a version.
        std::string_view magic;
        /// When all files together exceed this number of bytes, the oldest are removed.
        std::uint64_t limit = 0;
    };

    /// With an empty `folder`, no file is stored or found.
    KeptFiles(std::filesystem::path folder, const Kind& kind)
        : folder_(std::move(folder)), kind_(kind) {}

    bool is_on() const { return !folder_.empty(); }

    /// The content stored under this key. Both find() and keep() are thread-safe.
    std::optional<std::string> find(std::string_view key) const;

    /// Stores `content` if possible. Creates missing folders.
    void keep(std::string_view key, std::string_view content);

private:
    std::string name_of(std::string_view key) const;
    bool is_name(std::string_view name) const;
    void remove_oldest(const Descriptor& folder) const;

    std::filesystem::path folder_;
    Kind kind_;
    std::atomic<unsigned> kept_{0};  ///< Number of calls of `keep`.
};

}  // namespace cascade
