#include "core/descriptor.h"

#include <cerrno>
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

}  // namespace cascade
