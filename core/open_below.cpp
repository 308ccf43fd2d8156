// Uses openat2() with RESOLVE_BENEATH if available, otherwise openat() with O_NOFOLLOW for each
// part.
#include "core/open_below.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#ifdef SYS_openat2
#include <linux/openat2.h>
#endif

namespace cascade {

namespace {

namespace fs = std::filesystem;

constexpr int file_flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

/// Repeats a call that signals interrupt. Returns the call's descriptor, or the negative error
/// number.
template <typename Call>
int without_signals(const Call& call) {
    while (true) {
        const auto number = call();
        if (number >= 0) return static_cast<int>(number);
        if (errno != EINTR) return -errno;
    }
}

int open_by_kernel([[maybe_unused]] const Descriptor& folder,
                   [[maybe_unused]] const fs::path& file) {
#ifdef SYS_openat2
    open_how how{};
    how.flags = file_flags;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
    return without_signals(
        [&] { return ::syscall(SYS_openat2, folder.number(), file.c_str(), &how, sizeof how); });
#else
    return -ENOSYS;
#endif
}

int open_by_parts(const Descriptor& folder, const fs::path& file) {
    int here = -1;  // The folder reached so far; negative at the start.
    for (auto part = file.begin(); part != file.end(); ++part) {
        const bool is_last = std::next(part) == file.end();
        const Descriptor above(here);
        here = without_signals([&] {
            return ::openat(above.is_open() ? above.number() : folder.number(), part->c_str(),
                            O_NOFOLLOW | (is_last ? file_flags : O_PATH | O_DIRECTORY | O_CLOEXEC));
        });
        if (here < 0) return here;
    }
    return here;
}

}  // namespace

int open_below(const Descriptor& folder, const fs::path& file, PathWalk walk) {
    if (file.empty() || file.is_absolute()) return -EXDEV;
    for (const fs::path& part : file) {
        if (part == "..") return -EXDEV;
    }
    if (walk == PathWalk::kernel_or_parts) {
        const int number = open_by_kernel(folder, file);
        // These errors mean an old kernel, a container that forbids the call, or names that changed
        // meanwhile.
        if (number != -ENOSYS && number != -EPERM && number != -EAGAIN) return number;
    }
    return open_by_parts(folder, file);
}

}  // namespace cascade
