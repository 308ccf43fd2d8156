// The folder of a saved run, whose files are replaced all at once.
//
// run.json decides which files are the run: it names each one with its size and checksum. New files
// are written beside the old ones under temporary names, which the new run.json tells; then that
// takes the place of the old one, by one rename; and only then do the files take their own names,
// and run.json forgets the others. A writer that is killed at any moment leaves the old run or the
// new one, whole, and the next one tidies up. Files that no run.json names are nobody's business
// here. Runs of earlier versions name no files; theirs are the arrays of their stages.
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

/// While it lives, no other process changes the folder (or, shared, others may read it too). It
/// waits for ten seconds at most. Advisory, and nothing on file systems that know no locks.
class FolderLock {
public:
    FolderLock(const std::filesystem::path& folder, bool shared);
    const Descriptor& folder() const { return folder_; }
    bool is_held() const { return is_held_; }
    /// Somebody else has not let go of it.
    bool is_refused() const { return is_refused_; }

private:
    Descriptor folder_;
    bool is_held_ = false;
    bool is_refused_ = false;
};

/// What run.json says of one file.
struct SavedFile {
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;  ///< FNV-1a, 64 bits.
    std::string written_as;      ///< Its temporary name, while it may lie there; else empty.
};

class SavedFolderChange {
public:
    /// Takes the folder, which is there, for itself and puts what a killed writer left in order.
    /// Fails where run.json is not of a saved run.
    static Result<std::unique_ptr<SavedFolderChange>> begin(const std::filesystem::path& folder);
    /// What was not committed has never been.
    ~SavedFolderChange();

    /// Writes a file of the new run. Fails, too, where something has its name that is not of the
    /// run before.
    Result<void> add(const std::string& name, std::string_view bytes);
    /// Makes the new run the one that is saved here; `manifest` is run.json but for its list of
    /// files. The files of the run before are removed. Returns the paths of the new ones, run.json
    /// last.
    Result<std::vector<std::filesystem::path>> commit(nlohmann::json manifest);

private:
    explicit SavedFolderChange(const std::filesystem::path& folder);
    Result<void> tidy();
    int replace_manifest(const nlohmann::json& manifest);

    std::filesystem::path path_;
    FolderLock lock_;
    std::vector<std::string> before_;         ///< Files of the run before.
    std::map<std::string, SavedFile> files_;  ///< Of the new run.
    bool is_committed_ = false;
};

/// May a run with these files be saved in the folder, if it is there? Looks as a change would.
Result<void> check_savable(const std::filesystem::path& folder,
                           const std::vector<std::string>& names);

/// run.json of a saved run: an object with "cascade" in it. Nothing else of it has been checked.
Result<nlohmann::json> read_saved_manifest(const std::filesystem::path& folder);

/// A file of a saved run, as `manifest` has it. Fails if its size or checksum is another, on links
/// and on all that is no file.
Result<std::string> read_saved_file(const std::filesystem::path& folder,
                                    const nlohmann::json& manifest, const std::string& name);

}  // namespace cascade
