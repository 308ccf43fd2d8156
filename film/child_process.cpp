// posix_spawn() with a pipe for the input and an unnamed temporary file for errors, which cannot
// fill up and block as a second pipe would.
#include "film/child_process.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace cascade {
namespace {

/// The attributes and file actions for posix_spawn().
struct Orders {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    Orders() {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
    }
    ~Orders() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    Orders(const Orders&) = delete;
    Orders& operator=(const Orders&) = delete;
};

std::string last_line(std::FILE* file) {
    std::string text;
    std::array<char, 4096> part{};
    std::rewind(file);
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), file)) {
        text.append(part.data(), count);
    }
    while (!text.empty() && std::strchr("\r\n ", text.back())) text.pop_back();
    const std::size_t begin = text.find_last_of("\r\n");
    return begin == std::string::npos ? text : text.substr(begin + 1);
}

}  // namespace

bool is_program(const std::filesystem::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
           ::access(path.c_str(), X_OK) == 0;
}

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(
    const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    const std::string name = program.filename().string();
    const auto cannot = [&](int error) {
        return failure(fmt::format("{} cannot be started: {}", name, std::strerror(error)));
    };
    std::unique_ptr<ChildProcess> child(new ChildProcess);
    child->errors_.reset(std::tmpfile());
    std::array<int, 2> ends{};
    if (!child->errors_ || ::pipe2(ends.data(), O_CLOEXEC) != 0) return cannot(errno);
    const Descriptor its_end(ends[0]);
    child->input_.emplace(ends[1]);

    Orders orders;
    posix_spawn_file_actions_adddup2(&orders.files, its_end.number(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&orders.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&orders.files, ::fileno(child->errors_.get()), STDERR_FILENO);
    // Signals that this program ignores are not ignored there.
    sigset_t usual;
    sigemptyset(&usual);
    for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM}) sigaddset(&usual, signal);
    posix_spawnattr_setsigdefault(&orders.attributes, &usual);
    posix_spawnattr_setpgroup(&orders.attributes, 0);
    posix_spawnattr_setflags(&orders.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);

    std::vector<char*> words = {const_cast<char*>(name.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int error = posix_spawn(&child->process_, program.c_str(), &orders.files,
                                  &orders.attributes, words.data(), environ);
    if (error != 0) {
        child->process_ = -1;
        return cannot(error);
    }
    return child;
}

ChildProcess::~ChildProcess() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    (void)end();
}

bool ChildProcess::write(std::string_view bytes) { return write_all(*input_, bytes) == 0; }

ChildProcess::End ChildProcess::end() {
    input_.reset();
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    End end;
    end.is_good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    end.last_words = last_line(errors_.get());
    if (end.last_words.empty()) {
        end.last_words = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                             : fmt::format("status {}", WEXITSTATUS(status));
    }
    return end;
}

}  // namespace cascade
