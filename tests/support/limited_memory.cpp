#include "tests/support/limited_memory.h"

#include <array>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// Detects the address and thread sanitizers: g++ defines macros, clang has features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define has_sanitizer 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define has_sanitizer 1
#endif
#endif
#ifndef has_sanitizer
#define has_sanitizer 0
#endif

namespace cascade::test {

namespace {

/// Private memory of this process that can be written to, in bytes: what RLIMIT_DATA counts.
[[maybe_unused]] std::uint64_t data_size() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::uint64_t kilobytes = 0;
        if (word == "VmData:" && status >> kilobytes) return kilobytes * 1024;
    }
    return 0;
}

}  // namespace

std::string in_limited_memory(std::uint64_t bytes, const std::function<std::string()>& action) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
#if !has_sanitizer
        const rlim_t limit = data_size() + bytes;
        const rlimit limits{limit, limit};
        ::setrlimit(RLIMIT_DATA, &limits);
#else
        (void)bytes;
#endif
        const std::string text = action();
        const bool done =
            ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        ::_exit(done ? 0 : 1);
    }
    ::close(ends[1]);
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t count; (count = ::read(ends[0], piece.data(), piece.size())) > 0;) {
        text.append(piece.data(), static_cast<std::size_t>(count));
    }
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "died";
}

}  // namespace cascade::test
