// The first program (cmake/first.cmake) calls this function instead of functions that it leaves
// out. This function makes the launcher build the whole program, which then runs the same command.

#include "app/exit_status.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

namespace {

/// Returns the words of the command line, with the launcher's path in place of the first word.
std::vector<std::string> words_for(const std::filesystem::path& launcher) {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < text.size();) {
        words.emplace_back(text.c_str() + begin);
        begin += words.back().size() + 1;
    }
    if (words.empty()) words.emplace_back();
    words[0] = launcher.string();
    return words;
}

/// Takes back the limits of this run, which the compiler would inherit.
void remove_limits() {
    const itimerval never = {};
    ::setitimer(ITIMER_REAL, &never, nullptr);
    rlimit memory = {};
    ::getrlimit(RLIMIT_DATA, &memory);
    memory.rlim_cur = memory.rlim_max;
    ::setrlimit(RLIMIT_DATA, &memory);
    sigset_t none;
    ::sigemptyset(&none);
    ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace

extern "C" [[noreturn]] void cascade_left_out() {
    std::error_code unknown;
    const auto build = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    const auto launcher = build.parent_path().parent_path() / "cascade";
    if (std::getenv("CASCADE_WHOLE") == nullptr) {
        ::setenv("CASCADE_WHOLE", "1", 1);  // cmake/fresh.sh reads this variable.
        remove_limits();
        std::vector<std::string> words = words_for(launcher);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        ::execv(launcher.c_str(), arguments.data());
    }
    std::cerr << "cascade: this program can draw only a first picture, and " << launcher.string()
              << " could not build the whole program\n";
    std::_Exit(cascade::exit_status::bug);
}
