// Appends to a TemporaryFile and renames it at the end.
#include "core/growing_file.h"

#include "core/file_failure.h"
#include "core/link_target.h"

#include <cerrno>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cascade {

GrowingFile::GrowingFile(const std::filesystem::path& path, const std::filesystem::path& target)
    : path_(path), target_(target), folder_(open_folder(folder_of(target))) {}

Result<void> check_can_grow(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(behind_links(path).c_str(), &status) != 0) return {};
    if (S_ISDIR(status.st_mode)) return cannot("write", path.string(), EISDIR);
    if (S_ISREG(status.st_mode)) return {};
    return failure(fmt::format("cannot write '{}': it is a pipe or a device", path.string()),
                   "name a new file: the beginning of such a file is written last");
}

Result<std::unique_ptr<GrowingFile>> GrowingFile::create(const std::filesystem::path& path) {
    if (auto can = check_can_grow(path); !can) return tl::unexpected(can.error());
    std::unique_ptr<GrowingFile> file(new GrowingFile(path, behind_links(path)));
    if (!file->folder_.is_open()) return cannot("write", path.string(), errno);
    file->file_.emplace(file->folder_);
    if (const int error = file->file_->error()) return cannot("write", path.string(), error);
    // The new file gets the permissions of the replaced one, if possible.
    struct stat replaced {};
    if (::stat(file->target_.c_str(), &replaced) == 0) {
        (void)::fchmod(file->file_->file().number(), replaced.st_mode & 07777);
    }
    return file;
}

std::filesystem::path GrowingFile::temporary_path() const {
    return folder_of(target_) / file_->name();
}

Result<void> GrowingFile::append(std::string_view bytes) { return replace_end(size_, bytes); }

Result<void> GrowingFile::replace_end(std::uint64_t place, std::string_view bytes) {
    const int number = file_->file().number();
    std::string former(size_ - place, '\0');
    const ssize_t read = ::pread(number, former.data(), former.size(), static_cast<off_t>(place));
    if (read != static_cast<ssize_t>(former.size())) return cannot("read", path_.string(), EIO);
    if (auto done = overwrite(place, bytes); !done) {
        (void)overwrite(place, former);
        [[maybe_unused]] const int cut = ::ftruncate(number, static_cast<off_t>(size_));
        return done;
    }
    size_ = place + bytes.size();
    return {};
}

Result<void> GrowingFile::overwrite(std::uint64_t place, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written =
            ::pwrite(file_->file().number(), bytes.data(), bytes.size(), static_cast<off_t>(place));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return cannot("write", path_.string(), written < 0 ? errno : ENOSPC);
        bytes.remove_prefix(static_cast<std::size_t>(written));
        place += static_cast<std::uint64_t>(written);
    }
    return {};
}

Result<void> GrowingFile::appear() {
    if (const int error = file_->take_name(target_.filename().string())) {
        return cannot("write", path_.string(), error);
    }
    has_appeared_ = true;
    return {};
}

Result<void> GrowingFile::complete() {
    int error = file_->write({});  // Syncs to disk.
    if (error == 0) {
        error = has_appeared_ ? file_->stay() : file_->rename_to(target_.filename().string());
    }
    if (error != 0) return cannot("write", path_.string(), error);
    return {};
}

}  // namespace cascade
