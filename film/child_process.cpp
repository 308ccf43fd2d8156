// Uses posix_spawn() with a pipe for the input. The process writes errors to an unnamed temporary
// file, because a second pipe could fill up and block the process. No call here waits without a
// limit, because a process that hangs would otherwise prevent this program from ending.
#include "film/child_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace cascade {
namespace {

/// The attributes and file actions of posix_spawn().
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

/// A second reading end of the pipe, by which this program finds bytes that no process has read.
/// Invalid if the system has no /proc.
Descriptor reader_of(const Descriptor& input) {
    const std::string name = fmt::format("/proc/self/fd/{}", input.number());
    return Descriptor(::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
}

bool has_bytes(const Descriptor& reader) {
    char byte = 0;
    return reader.is_open() && ::read(reader.number(), &byte, 1) == 1;
}

/// The processor time that a process has used. 0 if the process has ended.
std::chrono::nanoseconds time_computed(pid_t process) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
        return {};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

bool is_program(const std::filesystem::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
           ::access(path.c_str(), X_OK) == 0;
}

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(const std::filesystem::path& program,
                                                          const std::vector<std::string>& arguments,
                                                          Patience patience) {
    const std::string name = program.filename().string();
    const auto cannot = [&](int error) {
        return failure(fmt::format("{} cannot be started: {}", name, std::strerror(error)));
    };
    std::unique_ptr<ChildProcess> child(new ChildProcess(patience));
    child->errors_.reset(std::tmpfile());
    std::array<int, 2> ends{};
    if (!child->errors_ || ::pipe2(ends.data(), O_CLOEXEC) != 0) return cannot(errno);
    const Descriptor its_end(ends[0]);
    child->input_.emplace(ends[1]);
    ::fcntl(ends[1], F_SETFL, O_NONBLOCK);

    Orders orders;
    posix_spawn_file_actions_adddup2(&orders.files, its_end.number(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&orders.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&orders.files, ::fileno(child->errors_.get()), STDERR_FILENO);
    // The child must not inherit the signals that this program ignores.
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
    give_up();
    (void)end();
}

void ChildProcess::give_up() {
    is_given_up_ = true;
    ::kill(-process_, SIGKILL);
}

/// Whether this program must end and the process makes no progress.
bool ChildProcess::is_hopeless() {
    if (!patience_.is_over) {
        begin_waiting();
        return false;
    }
    const Clock::time_point now = Clock::now();
    const std::chrono::nanoseconds computed = time_computed(process_);
    if (computed != computed_) active_at_ = now;
    computed_ = computed;
    return now - std::max(active_at_, taken_at_) >= patience_.while_idle ||
           now - taken_at_ >= patience_.while_busy;
}

bool ChildProcess::write(std::string_view bytes) {
    begin_waiting();
    while (!bytes.empty()) {
        const ssize_t written = ::write(input_->number(), bytes.data(), bytes.size());
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
            begin_waiting();
            continue;
        }
        if (errno == EINTR) continue;
        has_refused_ = errno != EAGAIN || is_hopeless();
        if (has_refused_) return false;
        pollfd room{input_->number(), POLLOUT, 0};
        ::poll(&room, 1, 100);
    }
    return true;
}

ChildProcess::End ChildProcess::end() {
    const Descriptor rest = reader_of(*input_);
    input_.reset();
    begin_waiting();
    int status = 0;
    for (int milliseconds = 1;; milliseconds = std::min(2 * milliseconds, 50)) {
        const pid_t ended = ::waitpid(process_, &status, is_given_up_ ? 0 : WNOHANG);
        if (ended == process_ || (ended < 0 && errno != EINTR)) break;
        if (!is_given_up_ && is_hopeless()) give_up();
        else ::poll(nullptr, 0, milliseconds);
    }
    process_ = -1;
    End end;
    const bool has_read_all = !has_refused_ && !has_bytes(rest);
    const bool is_success = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    end.is_good = is_success && has_read_all && !is_given_up_;
    end.last_words = last_line(errors_.get());
    if (is_given_up_) {
        end.last_words = "it made no progress and was stopped";
    } else if (is_success && !has_read_all) {
        end.last_words = "it ended before all frames were written";
    } else if (end.last_words.empty()) {
        end.last_words = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                             : fmt::format("status {}", WEXITSTATUS(status));
    }
    return end;
}

}  // namespace cascade
