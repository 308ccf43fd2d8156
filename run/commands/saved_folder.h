// The folder of a saved run. Its files are replaced atomically.
//
// run.json lists the files of the run with their sizes and checksums. New files are first written
// under temporary names in the same folder. The new run.json contains these names, and replaces the
// old one in a single rename. Only after that are the new files renamed and the old ones removed.
// So if a writer is killed at any moment, the folder contains either the old run or the new one
// completely, and the next writer removes what is left over. Other files are not touched. A
// run.json of an earlier version has no list. The files of its run are the arrays of the stages.
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

/// Locks a folder against changes by other processes, as long as the object exists. A shared lock
/// allows other readers. The constructor waits for the lock for at most ten seconds. The lock is
/// advisory, and has no effect on file systems without locks.
class FolderLock {
public:
    FolderLock(const std::filesystem::path& folder, bool shared);
    const Descriptor& folder() const { return folder_; }
    bool is_held() const { return is_held_; }
    /// Whether the constructor gave up because another process held the lock.
    bool is_refused() const { return is_refused_; }

private:
    Descriptor folder_;
    bool is_held_ = false;
    bool is_refused_ = false;
};

/// The entry of a file in run.json.
struct SavedFile {
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;  ///< FNV-1a, 64 bits.
    /// The temporary name that the file may still have. Empty if the file has certainly been
    /// renamed.
    std::string written_as;
};

class SavedFolderChange {
public:
    /// Locks the folder, which must exist, and removes the files that a killed writer has left.
    /// Fails if run.json does not belong to a saved run.
    static Result<std::unique_ptr<SavedFolderChange>> begin(const std::filesystem::path& folder);
    /// Removes the new files if commit() has not succeeded.
    ~SavedFolderChange();

    /// Writes a file of the new run. Also fails if the folder has a file of that name that is not
    /// part of the previous run.
    Result<void> add(const std::string& name, std::string_view bytes);
    /// Makes the new run replace the previous one, whose files are removed. `manifest` is run.json
    /// without the list of files. Returns the paths of the new files, run.json last.
    Result<std::vector<std::filesystem::path>> commit(nlohmann::json manifest);

private:
    explicit SavedFolderChange(const std::filesystem::path& folder);
    Result<void> tidy();
    int replace_manifest(const nlohmann::json& manifest);

    std::filesystem::path path_;
    FolderLock lock_;
    std::vector<std::string> before_;         ///< Files of the previous run.
    std::map<std::string, SavedFile> files_;  ///< Files of the new run.
    bool is_committed_ = false;
};

/// Checks whether a run with these files could be saved in the folder. A folder that does not exist
/// is no error.
Result<void> check_savable(const std::filesystem::path& folder,
                           const std::vector<std::string>& names);

/// Reads run.json, which must be an object with a member "cascade". Its other members are not
/// checked.
Result<nlohmann::json> read_saved_manifest(const std::filesystem::path& folder);

/// Reads a file of a saved run. Fails if size or checksum differ from the manifest, or if it is not
/// a regular file.
Result<std::string> read_saved_file(const std::filesystem::path& folder,
                                    const nlohmann::json& manifest, const std::string& name);

}  // namespace cascade
