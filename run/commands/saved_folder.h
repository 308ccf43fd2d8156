// The folder of a saved run, whose files are replaced atomically.
//
// run.json defines which files belong to the run: it lists each with its size and checksum. New
// files are written beside the old ones under temporary names, which the new run.json lists; then
// it replaces the old run.json by one rename; only then are the files renamed, and the old ones
// removed. A writer that is killed at any moment leaves the old run or the new one complete, and
// the next writer cleans up. Files that no run.json lists are not touched. Runs of earlier versions
// list no files; theirs are the arrays of their stages.
#pragma once

#include "core/descriptor.h"
#include "core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// While it exists, no other process changes the folder; if shared, others may read it, too. Waits
/// for at most ten seconds. Advisory, and without effect on file systems without locks.
class FolderLock {
public:
    FolderLock(const std::filesystem::path& folder, bool shared);
    const Descriptor& folder() const { return folder_; }
    bool is_held() const { return is_held_; }
    /// Another process still holds it.
    bool is_refused() const { return is_refused_; }

private:
    Descriptor folder_;
    bool is_held_ = false;
    bool is_refused_ = false;
};

/// The entry of one file in run.json.
struct SavedFile {
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;  ///< FNV-1a, 64 bits.
    std::string written_as;      ///< Its temporary name, as long as it may have that; else empty.
};

class SavedFolderChange {
public:
    /// Locks the folder, which must exist, and cleans up after a killed writer. Fails if run.json
    /// is not that of a saved run.
    static Result<std::unique_ptr<SavedFolderChange>> begin(const std::filesystem::path& folder);
    /// Discards what was not committed.
    ~SavedFolderChange();

    /// Writes a file of the new run. Also fails if a file of that name is not part of the previous
    /// run.
    Result<void> add(const std::string& name, std::string_view bytes);
    /// Replaces the previous run and removes its files; `manifest` is run.json without its list of
    /// files. Returns the paths of the new files, run.json last.
    Result<std::vector<std::filesystem::path>> commit(nlohmann::json manifest);

private:
    explicit SavedFolderChange(const std::filesystem::path& folder);
    Result<void> tidy();
    int replace_manifest(const nlohmann::json& manifest);

    std::filesystem::path path_;
    FolderLock lock_;
    std::vector<std::string> before_;         ///< Files of the previous run.
    std::map<std::string, SavedFile> files_;  ///< Of the new run.
    bool is_committed_ = false;
};

/// Checks that a run with these files could be saved in the folder, if it exists.
Result<void> check_savable(const std::filesystem::path& folder,
                           const std::vector<std::string>& names);

/// run.json of a saved run: an object that has "cascade". Nothing else in it is checked.
Result<nlohmann::json> read_saved_manifest(const std::filesystem::path& folder);

/// A file of a saved run. Fails if its size or checksum differs from the manifest, and on anything
/// but a regular file.
Result<std::string> read_saved_file(const std::filesystem::path& folder,
                                    const nlohmann::json& manifest, const std::string& name);

}  // namespace cascade
