// Kept files, on POSIX systems.
#include "core/kept_files.h"

#include "core/descriptor.h"
#include "core/hash.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <vector>

namespace cascade {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view unfinished_suffix = ".new";
constexpr std::uint64_t largest_file = std::uint64_t{16} << 20;

/// How a file begins. Key and content follow, and then it ends.
struct Header {
    char magic[8] = {};
    std::uint64_t checksum = 0;  ///< Of all behind it.
    std::uint64_t key_size = 0;
    std::uint64_t content_size = 0;
};
static_assert(sizeof(Header) == 32);
constexpr std::size_t checked_from = 16;

/// May nobody but this user have put it there?
bool is_private(const struct stat& status) {
    return status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// A link to a folder is none: whoever owns the link decides where it leads.
bool is_own_folder(const fs::path& folder) {
    struct stat status {};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && is_private(status);
}

std::string read_own_file(const fs::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
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
    // A file that was used is young again, so that those go first that nobody uses; once a day is
    // enough to know that.
    constexpr long day = 24 * 60 * 60;
    if (status.st_mtime + day < ::time(nullptr)) ::futimens(file.number(), nullptr);
    return bytes;
}

bool write_new_file(const fs::path& path, std::string_view bytes) {
    const Descriptor file(
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
    return file.is_open() && write_all(file, bytes) == 0;
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

std::optional<std::string> content_of(std::string_view file, std::string_view magic, std::string_view key) {
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

/// Makes a folder that is the user's alone, and those above it as they usually are.
bool make_own_folder(const fs::path& folder) {
    if (is_own_folder(folder)) return true;
    std::error_code error;
    fs::create_directories(folder.parent_path(), error);
    return ::mkdir(folder.c_str(), 0700) == 0 || (errno == EEXIST && is_own_folder(folder));
}

}  // namespace

std::filesystem::path KeptFiles::path_of(std::string_view key) const {
    return folder_ / fmt::format("{:016x}{:016x}{}", fnv1a(key), fnv1a(key, 0x6c62272e07bb0142ULL),
                                 kind_.suffix);
}

std::optional<std::string> KeptFiles::find(std::string_view key) const {
    if (!is_on() || !is_own_folder(folder_)) return std::nullopt;
    return content_of(read_own_file(path_of(key)), kind_.magic, key);
}

void KeptFiles::keep(std::string_view key, std::string_view content) {
    const std::string bytes = is_on() ? file_of(kind_.magic, key, content) : std::string();
    if (bytes.empty() || bytes.size() > largest_file || !make_own_folder(folder_)) return;
    // A day at the prompt may make many; looking through the folder takes as long as making one.
    constexpr unsigned often = 64;
    const unsigned number = kept_.fetch_add(1);
    if (number % often == 0) remove_oldest();
    const fs::path unfinished =
        folder_ / fmt::format("{}-{}-{}{}", static_cast<long>(::getpid()), number,
                              reinterpret_cast<std::uintptr_t>(this), unfinished_suffix);
    if (!write_new_file(unfinished, bytes) ||
        ::rename(unfinished.c_str(), path_of(key).c_str()) != 0) {
        ::unlink(unfinished.c_str());
    }
}

void KeptFiles::remove_oldest() const {
    struct Kept {
        fs::file_time_type time;
        std::uint64_t size;
        fs::path path;
    };
    std::vector<Kept> files;
    std::uint64_t total = 0;
    std::error_code error;
    const auto an_hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
    for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
        const fs::path extension = at->path().extension();
        std::error_code fault;  // Another process may have removed it.
        const auto time = at->last_write_time(fault);
        const auto size = fault ? 0 : at->file_size(fault);
        if (fault) continue;
        // Left by a process that was killed while it wrote.
        if (extension == unfinished_suffix && time < an_hour_ago) fs::remove(at->path(), fault);
        if (extension != kind_.suffix) continue;
        files.push_back({time, size, at->path()});
        total += size;
    }
    if (total <= kind_.limit) return;
    std::sort(files.begin(), files.end(),
              [](const Kept& a, const Kept& b) { return a.time < b.time; });
    for (const Kept& file : files) {
        if (total <= kind_.limit / 4 * 3) break;
        fs::remove(file.path, error);
        total -= file.size;
    }
}

}  // namespace cascade
