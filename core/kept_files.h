// Small files kept on disk under keys, for later processes: compiled kernels and measurements.
//
// A folder has one file for each key. If anything is wrong with a file, its owner or the folder,
// the key counts as unknown; nothing here can fail a run. Processes may share the folder, because
// files appear under their names complete. A file holds the whole key, so that a hash collision
// does no harm, and a checksum of everything. The checksum guards against accidents only; against
// other users, files and folder must belong to this user and be writable by no one else.
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
    /// The common properties of the files of one kind. Several kinds may share a folder.
    struct Kind {
        std::string_view suffix;  ///< Of the names, such as ".kernel".
        std::string_view magic;   ///< The first eight bytes of each file, the last a version.
        std::uint64_t limit = 0;  ///< Total bytes above which the oldest are removed.
    };

    /// With an empty `folder` nothing is kept or found.
    KeptFiles(std::filesystem::path folder, const Kind& kind)
        : folder_(std::move(folder)), kind_(kind) {}

    bool is_on() const { return !folder_.empty(); }

    /// The content kept under this key. Thread-safe, as is `keep`.
    std::optional<std::string> find(std::string_view key) const;

    /// Keeps `content` if possible. Creates the folder and its parents if they are missing.
    void keep(std::string_view key, std::string_view content);

private:
    std::string name_of(std::string_view key) const;
    bool is_name(std::string_view name) const;
    void remove_oldest(const Descriptor& folder) const;

    std::filesystem::path folder_;
    Kind kind_;
    std::atomic<unsigned> kept_{0};  ///< Calls of `keep`.
};

}  // namespace cascade
