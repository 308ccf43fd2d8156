// Writing files on POSIX systems.
#include "core/file.h"

#include "core/descriptor.h"
#include "core/file_failure.h"
#include "core/link_target.h"
#include "core/temporary_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cascade {
namespace {

namespace fs = std::filesystem;

/// open(), repeated after signals. `mode` only matters when a file is created.
int open_file(const fs::path& path, int flags, mode_t mode = 0) {
    int number = -1;
    do {
        number = ::open(path.c_str(), flags | O_CLOEXEC, mode);
    } while (number < 0 && errno == EINTR);
    return number;
}

/// Does the same as write_all() for a descriptor opened with O_NONBLOCK. A signal that this process
/// handles ends the wait, so Ctrl-C need not wait for the reader of a pipe.
int write_all_waiting(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
            continue;
        }
        if (written == 0) return ENOSPC;
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return errno;
        pollfd ready{file.number(), POLLOUT, 0};
        if (::poll(&ready, 1, -1) < 0) return errno;
    }
    return 0;
}

/// Writes directly to a pipe or device, because a rename would replace the pipe or device by a
/// file.
Result<void> write_in_place(const fs::path& path, std::string_view bytes) {
    Descriptor file(open_file(path, O_WRONLY | O_NONBLOCK));
    if (!file.is_open() && errno == ENXIO) {
        return failure(fmt::format("cannot write '{}': no program reads this pipe", path.string()),
                       "begin to read the pipe before the run ends, or name a file");
    }
    if (!file.is_open()) return cannot("write", path.string(), errno);
    if (const int error = write_all_waiting(file, bytes))
        return cannot("write", path.string(), error);
    if (!file.close()) return cannot("write", path.string(), errno);
    return {};
}

/// Writes a new file at `target`. `replaced` is the status of the file that the new file replaces,
/// or null. Returns 0 or the error number.
int replace(const fs::path& target, std::string_view bytes, const struct stat* replaced) {
    const Descriptor folder(open_folder(folder_of(target)));
    if (!folder.is_open()) return errno;
    TemporaryFile temporary(folder);
    if (const int error = temporary.error()) return error;
    // The new file gets the permissions of the replaced one, if possible. If that fails, the new
    // file is kept nevertheless.
    if (replaced) (void)::fchmod(temporary.file().number(), replaced->st_mode & 07777);
    if (const int error = temporary.write(bytes)) return error;
    return temporary.rename_to(target.filename().string());
}

}  // namespace

Result<void> write_file(const fs::path& path, std::string_view bytes) {
    const fs::path target = behind_links(path);
    struct stat status {};
    const bool exists = ::stat(target.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return cannot("write", path.string(), EISDIR);
    if (exists && !S_ISREG(status.st_mode)) return write_in_place(target, bytes);

    if (const int error = replace(target, bytes, exists ? &status : nullptr)) {
        return cannot("write", path.string(), error);
    }
    return {};
}

Result<void> check_writable(const fs::path& path) {
    if (path.empty()) return failure("cannot write a file without a name");
    const fs::path target = behind_links(path);
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) return cannot("write", path.string(), EISDIR);
        if (::access(target.c_str(), W_OK) != 0) return cannot("write", path.string(), errno);
        if (!S_ISREG(status.st_mode)) return {};
    } else if (errno != ENOENT) {
        return cannot("write", path.string(), errno);
    }
    if (!target.has_filename()) return cannot("write", path.string(), EISDIR);
    if (::stat(folder_of(target).c_str(), &status) != 0) {
        return failure(fmt::format("cannot write '{}': there is no folder '{}'", path.string(),
                                   folder_of(target).string()),
                       "make the folder first");
    }
    // Creates a file and removes it again, because only this shows whether permissions, read-only
    // disks and quotas allow the file.
    const Descriptor folder(open_folder(folder_of(target)));
    if (!folder.is_open()) return cannot("write", path.string(), errno);
    const TemporaryFile temporary(folder, 0600);
    if (temporary.error() != 0) return cannot("write", path.string(), temporary.error());
    return {};
}

Result<void> make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error) return {};
    return failure(
        fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
}

}  // namespace cascade
