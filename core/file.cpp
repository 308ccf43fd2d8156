// Reading and writing files on POSIX systems.
#include "core/file.h"

#include "core/descriptor.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cascade {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

tl::unexpected<Failure> cannot(const char* verb, const fs::path& path, int error) {
    std::string hint;
    if (error == ENOSPC || error == EDQUOT) hint = "free some space and run it again";
    return failure(fmt::format("cannot {} '{}': {}", verb, path.string(), reason(error)),
                   std::move(hint));
}

/// Opens again when a signal arrives first. The mode counts only where a file is made.
int open_file(const fs::path& path, int flags, mode_t mode = 0) {
    int number = -1;
    do {
        number = ::open(path.c_str(), flags | O_CLOEXEC, mode);
    } while (number < 0 && errno == EINTR);
    return number;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A name beside the target that no other process or thread of ours uses. It is short, so that it
/// fits wherever the target's name does.
fs::path temporary_beside(const fs::path& path) {
    static std::atomic<unsigned> count{0};
    return folder_of(path) /
           fmt::format(".cascade-{}-{}.tmp", static_cast<long>(::getpid()), count.fetch_add(1));
}

/// Where a write to this path ends: behind symbolic links, also one to a file not made yet. A
/// circle of links is left to the system to complain about.
fs::path behind_links(const fs::path& path) {
    fs::path target = path;
    std::error_code error;
    for (int link = 0; link < 40 && fs::is_symlink(target, error); ++link) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) break;
        target = folder_of(target) / next;  // An absolute `next` replaces the folder.
    }
    return target;
}

/// Pipes and devices are written in place: renaming over them would replace them.
Result<void> write_in_place(const fs::path& path, std::string_view bytes) {
    Descriptor file(open_file(path, O_WRONLY));
    if (!file.is_open()) return cannot("write", path, errno);
    if (const int error = write_all(file, bytes)) return cannot("write", path, error);
    if (!file.close()) return cannot("write", path, errno);
    return {};
}

/// Fills the new file `temporary` and returns 0 or the error.
int write_new(const fs::path& temporary, std::string_view bytes, const struct stat* replaced) {
    Descriptor file(open_file(temporary, O_WRONLY | O_CREAT | O_EXCL, 0666));
    if (!file.is_open()) return errno;
    // A file that is replaced keeps its permissions; refusing is no reason to lose the data.
    if (replaced && ::fchmod(file.number(), replaced->st_mode & 07777) != 0) errno = 0;
    if (const int error = write_all(file, bytes)) return error;
    // Without it a crash of the machine may leave the new name with no content behind it.
    if (::fsync(file.number()) != 0 && errno != EINVAL) return errno;
    return file.close() ? 0 : errno;
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::uint64_t largest) {
    const Descriptor file(open_file(path, O_RDONLY));
    if (!file.is_open()) return cannot("read", path, errno);
    struct stat status {};
    if (::fstat(file.number(), &status) != 0) return cannot("read", path, errno);
    if (S_ISDIR(status.st_mode)) return cannot("read", path, EISDIR);
    const auto too_large = [&] {
        return failure(fmt::format("'{}' is too large: at most {} bytes are read", path.string(),
                                   largest));
    };
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (S_ISREG(status.st_mode) && size > largest) return too_large();

    // A pipe tells no size, and a file may grow meanwhile: reading goes on until there is no more.
    std::string bytes;
    bytes.reserve(S_ISREG(status.st_mode) ? size + 1 : 0);
    constexpr std::size_t chunk = 1 << 16;
    for (std::size_t used = 0;;) {
        bytes.resize(std::max(used + chunk, bytes.capacity()));
        const ssize_t got = ::read(file.number(), bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return cannot("read", path, errno);
        used += static_cast<std::size_t>(got);
        if (used > largest) return too_large();
        if (got == 0) {
            bytes.resize(used);
            return bytes;
        }
    }
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
    const fs::path target = behind_links(path);
    struct stat status {};
    const bool exists = ::stat(target.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return cannot("write", path, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) return write_in_place(target, bytes);

    const fs::path temporary = temporary_beside(target);
    if (const int error = write_new(temporary, bytes, exists ? &status : nullptr)) {
        ::unlink(temporary.c_str());
        return cannot("write", path, error);
    }
    if (::rename(temporary.c_str(), target.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        return cannot("write", path, error);
    }
    return {};
}

Result<void> check_writable(const fs::path& path) {
    if (path.empty()) return failure("cannot write a file without a name");
    const fs::path target = behind_links(path);
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) return cannot("write", path, EISDIR);
        if (::access(target.c_str(), W_OK) != 0) return cannot("write", path, errno);
        if (!S_ISREG(status.st_mode)) return {};
    } else if (errno != ENOENT) {
        return cannot("write", path, errno);
    }
    if (!target.has_filename()) return cannot("write", path, EISDIR);
    if (::stat(folder_of(target).c_str(), &status) != 0) {
        return failure(fmt::format("cannot write '{}': there is no folder '{}'", path.string(),
                                   folder_of(target).string()),
                       "make the folder first");
    }
    // Trying is the only sure answer: permissions, read-only disks and quotas all have a say.
    const fs::path temporary = temporary_beside(target);
    Descriptor file(open_file(temporary, O_WRONLY | O_CREAT | O_EXCL, 0600));
    if (!file.is_open()) return cannot("write", path, errno);
    ::unlink(temporary.c_str());
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
