// Writers and readers lock the folder with flock(). Writers call fsync() after each phase of a
// change, before the next one begins.
#include "run/commands/saved_folder.h"

#include "core/file.h"
#include "core/hash.h"
#include "core/json_size.h"
#include "core/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <optional>
#include <system_error>
#include <thread>

namespace cascade {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "run.json";
constexpr std::string_view unfinished_ending = ".npy";
constexpr std::uint64_t largest_manifest = std::uint64_t{64} << 20;
constexpr std::uint64_t largest_array = std::uint64_t{1} << 36;

tl::unexpected<Failure> cannot_write(const fs::path& path, int error) {
    const bool is_full = error == ENOSPC || error == EDQUOT;
    return failure(fmt::format("cannot write '{}': {}", path.string(),
                               std::generic_category().message(error)),
                   is_full ? "free some space and run it again" : "");
}

bool is_manifest(const nlohmann::json& json) {
    return json.is_object() && json.contains("cascade");
}

/// Returns the entry of a file in run.json. Returns an empty optional if the entry is missing or
/// invalid.
std::optional<SavedFile> saved_file(const nlohmann::json& manifest, const std::string& name) {
    const bool is_array = name.ends_with(".npy") && name.find('/') == std::string::npos;
    const auto files = manifest.find("files");
    if (!is_array || files == manifest.end() || !files->is_object() || !files->contains(name))
        return std::nullopt;
    const nlohmann::json& entry = files->at(name);
    const auto text = [&](const char* key) {
        return entry.is_object() && entry.contains(key) && entry.at(key).is_string()
                   ? entry.at(key).get<std::string>()
                   : std::string();
    };
    SavedFile file;
    file.written_as = text("written_as");
    const std::string digits = text("fnv1a");
    const char* const end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, file.checksum, 16);
    const bool is_right =
        parsed.ec == std::errc() && parsed.ptr == end && entry.contains("bytes") &&
        entry.at("bytes").is_number_unsigned() &&
        (file.written_as.empty() || is_temporary_name(file.written_as, unfinished_ending));
    if (!is_right) return std::nullopt;
    file.bytes = entry.at("bytes").get<std::uint64_t>();
    return file;
}

/// Whether the file `name` has the form STAGE.NAME.npy and so belongs to a run of an earlier
/// version. The run.json of such a run has no list of files.
bool is_array_of_a_stage(const nlohmann::json& manifest, std::string_view name) {
    const auto stages = manifest.find("stages");
    if (!name.ends_with(".npy") || stages == manifest.end() || !stages->is_array()) return false;
    return std::any_of(stages->begin(), stages->end(), [&](const nlohmann::json& stage) {
        return stage.is_object() && stage.contains("name") && stage.at("name").is_string() &&
               name.starts_with(stage.at("name").get<std::string>() + ".");
    });
}

/// Returns the names of those files of a saved run that exist in the folder.
std::vector<std::string> files_of(const nlohmann::json& manifest, const Descriptor& folder) {
    std::vector<std::string> names = names_in(folder);
    const bool is_listed = manifest.contains("files");
    std::erase_if(names, [&](const std::string& name) {
        return is_listed ? !saved_file(manifest, name) : !is_array_of_a_stage(manifest, name);
    });
    return names;
}

/// Returns the content of run.json in the folder, if the file exists. Fails if run.json belongs to
/// another program.
Result<std::optional<nlohmann::json>> manifest_before(const fs::path& folder) {
    const fs::path path = folder / manifest_name;
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
    const auto text = read_plain_file(path, largest_manifest);
    auto json = text && is_small_json(*text) ? nlohmann::json::parse(*text, nullptr, false)
                                             : nlohmann::json();
    if (is_manifest(json)) return json;
    return failure(fmt::format("'{}' is not replaced, because it does not belong to a saved run",
                               path.string()),
                   "save into another folder");
}

/// Fails if the folder has a file with this name, and the file is not part of the previous run.
Result<void> check_name(const fs::path& folder, const std::string& name,
                        const std::vector<std::string>& before) {
    std::error_code error;
    const fs::path path = folder / name;
    const auto status = fs::symlink_status(path, error);
    if (!fs::exists(status)) return {};
    const bool is_known = std::find(before.begin(), before.end(), name) != before.end();
    if (fs::is_regular_file(status) && is_known) return {};
    return failure(
        fmt::format("'{}' is not replaced, because it does not belong to the run that is saved "
                    "there",
                    path.string()),
        "save into another folder");
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, bool shared)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    using namespace std::chrono_literals;
    if (!folder_.is_open()) return;
    for (int tries = 0; tries < 100; ++tries) {
        is_held_ = ::flock(folder_.number(), (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0;
        is_refused_ = !is_held_ && errno == EWOULDBLOCK;
        if (!is_refused_) return;
        std::this_thread::sleep_for(100ms);
    }
}

SavedFolderChange::SavedFolderChange(const fs::path& folder)
    : path_(folder), lock_(folder, false) {}

SavedFolderChange::~SavedFolderChange() {
    if (is_committed_) return;
    for (const auto& [name, file] : files_) {
        ::unlinkat(lock_.folder().number(), file.written_as.c_str(), 0);
    }
}

Result<std::unique_ptr<SavedFolderChange>> SavedFolderChange::begin(const fs::path& folder) {
    std::unique_ptr<SavedFolderChange> change(new SavedFolderChange(folder));
    if (!change->lock_.folder().is_open()) return cannot_write(folder, errno);
    if (change->lock_.is_refused()) {
        return failure(fmt::format("another run is being saved in '{}'", folder.string()),
                       "save each run into another folder");
    }
    if (auto done = change->tidy(); !done) return tl::unexpected(done.error());
    return change;
}

/// Completes the renames of a writer that was killed after its commit, and removes all other files
/// that killed writers have left.
Result<void> SavedFolderChange::tidy() {
    const int folder = lock_.folder().number();
    const auto manifest = manifest_before(path_);
    if (!manifest) return tl::unexpected(manifest.error());
    std::vector<std::string> kept;
    if (*manifest && (*manifest)->contains("files") && (*manifest)->at("files").is_object()) {
        for (const auto& entry : (*manifest)->at("files").items()) {
            const auto file = saved_file(**manifest, entry.key());
            if (!file || file->written_as.empty()) continue;
            ::renameat(folder, file->written_as.c_str(), folder, entry.key().c_str());
            kept.push_back(file->written_as);
        }
    }
    if (*manifest) before_ = files_of(**manifest, lock_.folder());
    // If this process has no lock, another process may be writing these files.
    if (!lock_.is_held()) return {};
    for (const std::string& name : names_in(lock_.folder())) {
        const bool is_known = std::find(kept.begin(), kept.end(), name) != kept.end();
        if (!is_temporary_name(name, unfinished_ending) || is_known) continue;
        ::unlinkat(folder, name.c_str(), 0);
    }
    return {};
}

Result<void> SavedFolderChange::add(const std::string& name, std::string_view bytes) {
    if (auto good = check_name(path_, name, before_); !good) return good;
    TemporaryFile file(lock_.folder(), 0666, unfinished_ending);
    if (const int error = file.write(bytes)) return cannot_write(path_ / name, error);
    if (const int error = file.stay()) return cannot_write(path_ / name, error);
    files_[name] = {bytes.size(), fnv1a(bytes), file.name()};
    return {};
}

/// Replaces run.json. The rename of run.json is the moment at which the new run replaces the old
/// one.
int SavedFolderChange::replace_manifest(const nlohmann::json& manifest) {
    const std::string text =
        manifest.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    const int folder = lock_.folder().number();
    if (::fsync(folder) != 0 && errno != EINVAL) return errno;
    TemporaryFile file(lock_.folder());
    if (const int error = file.write(text)) return error;
    if (const int error = file.rename_to(manifest_name)) return error;
    is_committed_ = true;
    // Even if the machine crashes, no other rename may reach the disk before the rename of
    // run.json.
    return ::fsync(folder) == 0 || errno == EINVAL ? 0 : errno;
}

Result<std::vector<fs::path>> SavedFolderChange::commit(nlohmann::json manifest) {
    nlohmann::json& list = manifest["files"] = nlohmann::json::object();
    for (const auto& [name, file] : files_) {
        list[name] = {{"bytes", file.bytes},
                      {"fnv1a", fmt::format("{:016x}", file.checksum)},
                      {"written_as", file.written_as}};
    }
    if (const int error = replace_manifest(manifest))
        return cannot_write(path_ / manifest_name, error);
    const int folder = lock_.folder().number();
    std::vector<fs::path> written;
    bool have_their_names = true;
    for (const auto& [name, file] : files_) {
        // If the rename fails, later readers find the file under its temporary name.
        const bool has_its_name =
            ::renameat(folder, file.written_as.c_str(), folder, name.c_str()) == 0;
        have_their_names = have_their_names && has_its_name;
        list[name].erase("written_as");
        written.push_back(path_ / name);
    }
    // Afterwards run.json contains no temporary names, so saving the same run again gives the same
    // bytes.
    if (have_their_names) (void)replace_manifest(manifest);
    for (const std::string& name : before_) {
        if (!files_.contains(name)) ::unlinkat(folder, name.c_str(), 0);
    }
    written.push_back(path_ / manifest_name);
    return written;
}

Result<void> check_savable(const fs::path& folder, const std::vector<std::string>& names) {
    std::error_code error;
    if (!fs::exists(folder, error)) return {};
    const auto manifest = manifest_before(folder);
    if (!manifest) return tl::unexpected(manifest.error());
    std::vector<std::string> before;
    const Descriptor opened(open_folder(folder));
    if (*manifest && opened.is_open()) before = files_of(**manifest, opened);
    for (const std::string& name : names) {
        if (auto good = check_name(folder, name, before); !good) return good;
    }
    return {};
}

Result<nlohmann::json> read_saved_manifest(const fs::path& folder) {
    const fs::path path = folder / manifest_name;
    const auto text = read_plain_file(path, largest_manifest);
    if (!text) {
        return failure(fmt::format("{} holds no saved run: {}", folder.string(),
                                   text.error().message),
                       "--resume takes a folder that --save has written");
    }
    if (!is_small_json(*text)) {
        return failure(fmt::format("the saved run in {} is damaged: run.json holds too much",
                                   folder.string()));
    }
    auto json = nlohmann::json::parse(*text, nullptr, false);
    if (is_manifest(json)) return json;
    return failure(fmt::format("{}: this is not a manifest of a saved run", path.string()));
}

Result<std::string> read_saved_file(const fs::path& folder, const nlohmann::json& manifest,
                                    const std::string& name) {
    if (!manifest.contains("files")) return read_plain_file(folder / name, largest_array);
    const auto file = saved_file(manifest, name);
    if (!file) return failure(fmt::format("run.json does not name {}", name));
    std::error_code error;
    const fs::path unfinished = folder / file->written_as;
    const bool has_its_name =
        file->written_as.empty() || !fs::exists(fs::symlink_status(unfinished, error));
    auto bytes = read_plain_file(has_its_name ? folder / name : unfinished, file->bytes);
    if (bytes && (bytes->size() != file->bytes || fnv1a(*bytes) != file->checksum)) {
        return failure(
            fmt::format("{} has changed since the run was saved: its checksum differs", name));
    }
    return bytes;
}

}  // namespace cascade
