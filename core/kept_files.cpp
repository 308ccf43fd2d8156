// Stores files on POSIX systems.
#include "core/kept_files.h"

#include "core/descriptor.h"
#include "core/hash.h"
#include "core/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>
#include <vector>

namespace cascade {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t digits_of_name = 32;
constexpr std::uint64_t largest_file = std::uint64_t{16} << 20;

/// The start of a file. The key and the content follow.
struct Header {
    char magic[8] = {};
    std::uint64_t checksum = 0;  ///< Checksum of all bytes after this member.
    std::uint64_t key_size = 0;
    std::uint64_t content_size = 0;
};
static_assert(sizeof(Header) == 32);
constexpr std::size_t checked_from = 16;

/// Whether only this user can have written the file.
bool is_private(const struct stat& status) {
    return status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Opens a folder of the user. Refuses links, because a link's owner decides where it leads.
int open_own_folder(const fs::path& folder) {
    Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    struct stat status {};
    if (!opened.is_open() || ::fstat(opened.number(), &status) != 0 || !is_private(status))
        return -1;
    return opened.release();
}

int open_to_read(const Descriptor& folder, const std::string& name) {
    return ::openat(folder.number(), name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
}

std::string read_own_file(const Descriptor& folder, const std::string& name) {
    const Descriptor file(open_to_read(folder, name));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0) return {};
    if (!S_ISREG(status.st_mode) || !is_private(status)) return {};
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > largest_file) return {};
    std::string bytes(size, '\0');
    for (std::size_t used = 0; used < bytes.size();) {
        const ssize_t got = ::read(file.number(), bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return {};
        used += static_cast<std::size_t>(got);
    }
    // Because the files unused for longest are removed first, the modification time records when a
    // file was last used, to within a day.
    constexpr long day = 24 * 60 * 60;
    if (status.st_mtime + day < ::time(nullptr)) ::futimens(file.number(), nullptr);
    return bytes;
}

std::uint64_t checksum_of(std::string_view file) { return fnv1a(file.substr(checked_from)); }

std::string file_of(std::string_view magic, std::string_view key, std::string_view content) {
    Header header;
    magic.copy(header.magic, sizeof header.magic);
    header.key_size = key.size();
    header.content_size = content.size();
    std::string file(sizeof header, '\0');
    std::memcpy(file.data(), &header, sizeof header);
    file += key;
    file += content;
    header.checksum = checksum_of(file);
    std::memcpy(file.data(), &header, sizeof header);
    return file;
}

std::optional<std::string> content_of(std::string_view file, std::string_view magic,
                                      std::string_view key) {
    Header header;
    if (file.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, file.data(), sizeof header);
    if (std::string_view(header.magic, sizeof header.magic) != magic) return std::nullopt;
    const std::uint64_t rest = file.size() - sizeof header;
    if (header.key_size > rest || header.content_size != rest - header.key_size ||
        header.checksum != checksum_of(file)) {
        return std::nullopt;
    }
    if (file.substr(sizeof header, header.key_size) != key) return std::nullopt;
    return std::string(file.substr(sizeof header + header.key_size));
}

/// Opens a folder. Creates a missing folder with access for this user only, and missing parents
/// with the usual access.
int make_own_folder(const fs::path& folder) {
    if (const int opened = open_own_folder(folder); opened >= 0) return opened;
    std::error_code error;
    fs::create_directories(folder.parent_path(), error);
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return -1;
    return open_own_folder(folder);
}

/// Whether a file starts with `magic`. Ignores the last byte of `magic`, which is a version.
bool has_magic(const Descriptor& folder, const std::string& name, std::string_view magic) {
    const Descriptor file(open_to_read(folder, name));
    char first[8] = {};
    if (!file.is_open() || ::read(file.number(), first, sizeof first) != sizeof first) return false;
    return std::string_view(first, sizeof first - 1) == magic.substr(0, sizeof first - 1);
}

}  // namespace

std::string KeptFiles::name_of(std::string_view key) const {
    return fmt::format("{:016x}{:016x}{}", fnv1a(key), fnv1a(key, 0x6c62272e07bb0142ULL),
                       kind_.suffix);
}

bool KeptFiles::is_name(std::string_view name) const {
    return name.size() == digits_of_name + kind_.suffix.size() && name.ends_with(kind_.suffix) &&
           name.substr(0, digits_of_name).find_first_not_of("0123456789abcdef") ==
               std::string_view::npos;
}

std::optional<std::string> KeptFiles::find(std::string_view key) const {
    if (!is_on()) return std::nullopt;
    const Descriptor folder(open_own_folder(folder_));
    if (!folder.is_open()) return std::nullopt;
    return content_of(read_own_file(folder, name_of(key)), kind_.magic, key);
}

void KeptFiles::keep(std::string_view key, std::string_view content) {
    const std::string bytes = is_on() ? file_of(kind_.magic, key, content) : std::string();
    if (bytes.empty() || bytes.size() > largest_file) return;
    const Descriptor folder(make_own_folder(folder_));
    if (!folder.is_open()) return;
    // Listing the folder takes as long as writing a file, so only every 64th call lists it.
    constexpr unsigned often = 64;
    if (kept_.fetch_add(1) % often == 0) remove_oldest(folder);
    // No fsync: a file that a crash leaves empty fails its checksum.
    TemporaryFile unfinished(folder, 0600);
    if (unfinished.error() != 0 || write_all(unfinished.file(), bytes) != 0) return;
    (void)unfinished.rename_to(name_of(key));
}

void KeptFiles::remove_oldest(const Descriptor& folder) const {
    struct Kept {
        std::pair<std::int64_t, std::int64_t> time;  ///< Seconds and nanoseconds.
        std::uint64_t size;
        std::string name;
    };
    std::vector<Kept> files;
    std::uint64_t total = 0;
    remove_dead_temporaries(folder);
    for (std::string& name : names_in(folder)) {
        struct stat status {};
        if (!is_name(name) ||
            ::fstatat(folder.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(status.st_mode)) {
            continue;
        }
        const auto size = static_cast<std::uint64_t>(status.st_size);
        files.push_back({{status.st_mtim.tv_sec, status.st_mtim.tv_nsec}, size, std::move(name)});
        total += size;
    }
    if (total <= kind_.limit) return;
    std::sort(files.begin(), files.end(),
              [](const Kept& a, const Kept& b) { return a.time < b.time; });
    for (const Kept& file : files) {
        if (total <= kind_.limit / 4 * 3) break;
        if (has_magic(folder, file.name, kind_.magic))
            ::unlinkat(folder.number(), file.name.c_str(), 0);
        total -= file.size;
    }
}

}  // namespace cascade
