// Small files kept on disk under keys, for the next process that asks for them: compiled kernels,
// and what runs find out about the machine.
//
// A folder with a file for each key. Everything that can be wrong with a file, its owner or the
// folder means that the key is not known; nothing here can fail a run. Processes may share the
// folder: files appear under their names whole. A file holds the whole key, so that a hash that two
// keys have in common does no harm, and a checksum of everything. The checksum stands against
// accidents; against other people stands that the files and the folder must belong to the user and
// nobody else may write to them.
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
    /// What the files of one kind have in common. Kinds may share a folder.
    struct Kind {
        std::string_view suffix;  ///< Of their names, as ".kernel".
        std::string_view magic;   ///< Eight bytes with which they begin; the last one is a version.
        std::uint64_t limit = 0;  ///< Bytes of all of them, above which the oldest are removed.
    };

    /// An empty folder: nothing is kept or found.
    KeptFiles(std::filesystem::path folder, const Kind& kind)
        : folder_(std::move(folder)), kind_(kind) {}

    bool is_on() const { return !folder_.empty(); }

    /// What is kept under this key. Safe to call from several threads, as is `keep`.
    std::optional<std::string> find(std::string_view key) const;

    /// Keeps something, if it can. The folder, and those above it, are made where they are missing.
    void keep(std::string_view key, std::string_view content);

private:
    std::string name_of(std::string_view key) const;
    bool is_name(std::string_view name) const;
    void remove_oldest(const Descriptor& folder) const;

    std::filesystem::path folder_;
    Kind kind_;
    std::atomic<unsigned> kept_{0};  ///< How many times.
};

}  // namespace cascade
