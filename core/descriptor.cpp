// Repeats system calls that a signal interrupted. Takes a write of 0 bytes for a full disk.
#include "core/descriptor.h"

#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <memory>
#include <unistd.h>

namespace cascade {

bool Descriptor::close() {
    if (!is_open()) return true;
    const int closing = number_;
    number_ = -1;
    return ::close(closing) == 0;
}

int write_all(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        if (written == 0) return ENOSPC;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

std::vector<std::string> names_in(const Descriptor& folder) {
    std::vector<std::string> names;
    // Reading a folder moves its descriptor's position, so a second descriptor is opened.
    const int again = ::openat(folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (again < 0) return names;
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(again), &::closedir);
    while (const dirent* const entry = entries ? ::readdir(entries.get()) : nullptr) {
        names.emplace_back(entry->d_name);
    }
    return names;
}

}  // namespace cascade
