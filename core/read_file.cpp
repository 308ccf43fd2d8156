// Reading files on POSIX systems.
#include "core/descriptor.h"
#include "core/file.h"
#include "core/file_failure.h"
#include "core/open_below.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cascade {
namespace {

namespace fs = std::filesystem;

/// Opens a file. Returns its descriptor or the negative error number.
int open_to_read(const fs::path& path, int flags) {
    int number = -1;
    do {
        number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
    } while (number < 0 && errno == EINTR);
    return number < 0 ? -errno : number;
}

enum class Accepted { everything, plain_files };

/// The content of an open file. `opened` is its descriptor or a negative error number.
Result<std::string> read_all(int opened, std::uint64_t largest, std::string_view name,
                             Accepted accepted) {
    const Descriptor file(opened);
    if (!file.is_open()) return cannot("read", name, -opened);
    struct stat status {};
    if (::fstat(file.number(), &status) != 0) return cannot("read", name, errno);
    if (S_ISDIR(status.st_mode)) return cannot("read", name, EISDIR);
    const bool is_plain = S_ISREG(status.st_mode);
    if (!is_plain && accepted == Accepted::plain_files) {
        return failure(fmt::format("'{}' is a pipe or a device, not a file", short_name(name)));
    }
    const auto too_large = [&] {
        return failure(
            fmt::format("'{}' is too large: at most {} bytes are read", short_name(name), largest));
    };
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (is_plain && size > largest) return too_large();

    // A pipe reports no size, and a file may grow meanwhile, so bytes are read until the end.
    std::string bytes;
    bytes.reserve(is_plain ? size + 1 : 0);
    constexpr std::size_t chunk = 1 << 16;
    for (std::size_t used = 0;;) {
        bytes.resize(std::max(used + chunk, bytes.capacity()));
        const ssize_t got = ::read(file.number(), bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return cannot("read", name, errno);
        used += static_cast<std::size_t>(got);
        if (used > largest) return too_large();
        if (got == 0) {
            bytes.resize(used);
            return bytes;
        }
    }
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::uint64_t largest) {
    return read_all(open_to_read(path, 0), largest, path.string(), Accepted::everything);
}

std::optional<std::uint64_t> size_of_file(const fs::path& path) {
    std::error_code unknown;
    const std::uint64_t size = fs::file_size(path, unknown);
    if (unknown) return std::nullopt;
    return size;
}

std::string first_bytes(const fs::path& path, std::size_t count) {
    const Descriptor file(open_to_read(path, O_NONBLOCK | O_NOCTTY));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
        return {};
    std::string bytes(count, '\0');
    const ssize_t got = ::read(file.number(), bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
}

Result<std::string> read_plain_file(const fs::path& path, std::uint64_t largest) {
    const int opened = open_to_read(path, O_NONBLOCK | O_NOCTTY | O_NOFOLLOW);
    if (opened == -ELOOP)
        return failure(fmt::format("'{}' is a link, not a file", short_name(path.string())));
    return read_all(opened, largest, path.string(), Accepted::plain_files);
}

Result<std::string> read_linked_file(const fs::path& path, std::uint64_t largest,
                                     std::string_view name) {
    return read_all(open_to_read(path, O_NONBLOCK | O_NOCTTY), largest,
                    name.empty() ? path.string() : std::string(name), Accepted::plain_files);
}

Result<std::string> read_file_below(const fs::path& folder, const fs::path& file,
                                    std::uint64_t largest, std::string_view name) {
    const int opened = open_to_read(folder, O_PATH | O_DIRECTORY);
    const Descriptor open_folder(opened);
    if (!open_folder.is_open()) return cannot("read", name, -opened);
    return read_all(open_below(open_folder, file), largest, name, Accepted::plain_files);
}

}  // namespace cascade
