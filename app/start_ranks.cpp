// Runs mpiexec as a child process in a separate process group, so that Ctrl-C in a terminal reaches
// only this process. On Ctrl-C, mpiexec would kill the ranks a second later.
#include "app/exit_status.h"
#include "app/mpiexec_output.h"
#include "app/process_tree.h"
#include "app/rank_process.h"
#include "core/printable.h"
#include "ranks/launcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <optional>
#include <poll.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cascade {
namespace {

// The signal handler reads and changes these, so they are global.
std::atomic<pid_t> mpiexec_process{0}, root_process{0};
std::atomic<int> interrupts{0};
static_assert(std::atomic<pid_t>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// The first signal ends the run after a batch of steps. The second signal ends it immediately.
extern "C" void pass_on(int) {
    const pid_t root = root_process, mpiexec = mpiexec_process;
    if (interrupts++ == 0 && root > 0) {
        ::kill(root, SIGINT);
    } else if (interrupts > 1 && mpiexec > 0) {
        ::kill(mpiexec, SIGTERM);
    }
}

/// Passes signals on as long as this object exists.
class PassedSignals {
public:
    PassedSignals() {
        struct sigaction action = {};
        action.sa_handler = pass_on;
        sigemptyset(&action.sa_mask);
        action.sa_flags = SA_RESTART;
        for (std::size_t k = 0; k < watched.size(); ++k) {
            sigaction(watched[k], &action, &saved_[k]);
        }
    }
    ~PassedSignals() {
        for (std::size_t k = 0; k < watched.size(); ++k) sigaction(watched[k], &saved_[k], nullptr);
    }
    PassedSignals(const PassedSignals&) = delete;
    PassedSignals& operator=(const PassedSignals&) = delete;

private:
    static constexpr std::array watched = {SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, watched.size()> saved_;
};

/// Returns the path of the library's mpiexec. Debian appends the library's name to the program's
/// name.
std::optional<std::filesystem::path> find_mpiexec(MpiLibrary library) {
    const char* const path = std::getenv("PATH");
    const bool is_mpich = library == MpiLibrary::mpich;
    for (const char* const name : {is_mpich ? "mpiexec.mpich" : "mpiexec.openmpi", "mpiexec"}) {
        std::istringstream folders(path ? path : "");
        for (std::string folder; std::getline(folders, folder, ':');) {
            const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name;
            if (::access(file.c_str(), X_OK) == 0) return file;
        }
    }
    return std::nullopt;
}

std::vector<std::string> command_line(const std::filesystem::path& mpiexec, MpiLibrary library,
                                      const Options& options) {
    std::error_code unknown;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    std::vector<std::string> words = {mpiexec.string()};
    if (library == MpiLibrary::open_mpi) {
        words.insert(words.end(), {"--oversubscribe", "--bind-to", "none"});
    }
    words.insert(words.end(), {"-n", std::to_string(options.ranks), program.string()});
    words.insert(words.end(), options.arguments.begin(), options.arguments.end());
    return words;
}

/// Pipes from mpiexec to this process. Each has an end from which this process reads (element 0),
/// and an end to which mpiexec writes (element 1).
struct Pipes {
    /// Open only for MPICH, which writes its explanations of failures to standard output.
    std::array<int, 2> output = {-1, -1};
    std::array<int, 2> errors = {-1, -1};

    ~Pipes() {
        for (const int end : {output[0], output[1], errors[0], errors[1]}) {
            if (end >= 0) ::close(end);
        }
    }
    void close_written() {
        for (int* const end : {&output[1], &errors[1]}) {
            if (*end >= 0) ::close(*end);
            *end = -1;
        }
    }
};

/// Turns this process, which is the child process, into mpiexec.
[[noreturn]] void become(std::vector<std::string> words, const Pipes& pipes) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(pipes.errors[1], STDERR_FILENO);
    if (pipes.output[1] >= 0) ::dup2(pipes.output[1], STDOUT_FILENO);
    if (::geteuid() == 0) {  // Open MPI asks twice before it starts ranks of the user root.
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    }
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
}

/// Remembers the process of rank 0, and passes on a signal that came before it was known.
void remember_root(const MpiexecOutput& output) {
    if (root_process > 0 || !output.root()) return;
    root_process = *output.root();
    if (interrupts > 0) ::kill(root_process, SIGINT);
}

/// Reads one of the streams of mpiexec and the ranks line by line.
struct ReadStream {
    int pipe = -1;
    std::function<void(const std::string& text)> pass_on;
    MpiexecOutput seen = {};
    std::string text = {};  ///< The part of the next line that has been read.

    /// Reads the available bytes. Returns whether the stream has ended.
    bool read_some() {
        std::array<char, 4096> buffer{};
        const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) return false;
        if (count <= 0) {
            if (!text.empty() && seen.takes(text)) pass_on(text);
            return true;
        }
        text.append(buffer.data(), static_cast<std::size_t>(count));
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;) {
            const std::string line = text.substr(begin, end - begin);
            if (seen.takes(line)) pass_on(line + "\n");
            remember_root(seen);
            begin = end + 1;
        }
        text.erase(0, begin);
        return false;
    }
};

/// What was learnt from the output of mpiexec and the ranks.
struct WrittenStreams {
    MpiexecOutput output, errors;
    /// Whether mpiexec was ended, because it did not notice the end of the ranks.
    bool is_stuck = false;
};

/// Ends mpiexec if all ranks have ended, but mpiexec still waits for them. Open MPI 4.1 waits
/// forever if a rank is killed while the ranks connect to each other.
class StuckLauncher {
public:
    /// look() must be called whenever this time has passed without output.
    static constexpr int milliseconds = 3000;
    /// Ends mpiexec if several successive looks have found no running rank. Returns whether mpiexec
    /// was ended.
    bool look() {
        const pid_t mpiexec = mpiexec_process;
        if (mpiexec <= 0) return false;
        looks_ = only_ended_below(mpiexec) ? looks_ + 1 : 0;
        if (looks_ < most_looks) return false;
        ::kill(mpiexec, SIGKILL);
        return true;
    }

private:
    static constexpr int most_looks = 4;
    int looks_ = 0;  ///< The number of successive looks that found no running rank.
};

/// Prints the messages of ranks until mpiexec and all ranks have closed the pipes.
WrittenStreams pass_messages_on(const Pipes& pipes, const Console& console) {
    StuckLauncher launcher;
    bool is_stuck = false;
    std::array streams = {
        ReadStream{pipes.errors[0],
                   [&](const std::string& text) { (void)console.error().write(text); }},
        ReadStream{pipes.output[0],
                   [&](const std::string& text) { (void)console.out().write(text); }},
    };
    while (true) {
        std::array<struct pollfd, streams.size()> polled{};
        for (std::size_t k = 0; k < streams.size(); ++k) polled[k] = {streams[k].pipe, POLLIN, 0};
        const bool is_over = std::all_of(streams.begin(), streams.end(),
                                         [](const ReadStream& each) { return each.pipe < 0; });
        if (is_over) return {streams[1].seen, streams[0].seen, is_stuck};
        const int ready = ::poll(polled.data(), polled.size(), StuckLauncher::milliseconds);
        if (ready < 0) continue;  // A signal has arrived.
        if (ready == 0) {
            is_stuck = launcher.look() || is_stuck;
            continue;
        }
        for (std::size_t k = 0; k < streams.size(); ++k) {
            if (polled[k].revents != 0 && streams[k].read_some()) streams[k].pipe = -1;
        }
    }
}

int wait_for(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : exit_status::signal_base + WTERMSIG(status);
}

/// Tells the user how to continue a run or a sweep after a rank was killed.
std::string how_to_go_on(const Options& options) {
    if (options.command == Command::sweep) {
        return "the same command goes on with the runs that are missing";
    }
    if (options.run.save.empty() || options.run.checkpoint_seconds <= 0) {
        return "with --save and --checkpoint such a run can be resumed";
    }
    return fmt::format(
        "'cascade run --resume {}' goes on from the last save, with any number of ranks",
        options.run.save.string());
}

/// Explains a failure, if no rank has done so, and returns the exit status.
int tell_end(const WrittenStreams& written, int status, const Options& options, Console& console) {
    if (status == exit_status::success) {
        console.leave_answer_to_other();
        return status;
    }
    if (written.errors.has_error()) {
        if (options.json) console.fail({"a rank has failed", "standard error says why"});
        return written.is_stuck ? exit_status::failed_run : status;
    }
    if (interrupts > 0) {
        if (interrupts == 1) console.leave_answer_to_other();
        if (interrupts > 1) console.say("cascade: ended at once; nothing has been written\n");
        return exit_status::signal_base + SIGINT;
    }
    std::string killed = written.errors.killed(written.errors);
    if (killed.empty()) killed = written.output.killed(written.errors);
    if (killed.empty() && written.is_stuck) killed = "a rank was killed";
    if (!killed.empty()) {
        console.fail({killed + ", so all ranks have ended", how_to_go_on(options)});
        return exit_status::failed_run;
    }
    const bool root_answers = options.json && written.errors.root();
    if (root_answers) console.leave_answer_to_other();
    if (status == exit_status::time_limit || root_answers) return status;
    for (const MpiexecOutput& each : {written.errors, written.output}) {
        if (!each.explanations().empty()) console.say(each.explanations());
    }
    console.fail({fmt::format("mpiexec has ended with status {}", status), ""});
    return exit_status::failed_run;
}

}  // namespace

int start_ranks(const Options& options, Console& console) {
    const auto fail = [&](const Failure& why) {
        console.fail(why);
        return exit_status::failed_run;
    };
    if (const auto readable = check_readable_by_ranks(options); !readable) {
        console.fail(readable.error());
        return exit_status::wrong_use;
    }
    const auto library = choose_mpi(options.mpi);
    if (!library) return fail(library.error());
    const auto mpiexec = find_mpiexec(*library);
    if (!mpiexec) {
        return fail({fmt::format("mpiexec of {}, which starts the ranks, is not installed",
                                 name_of(*library)),
                     fmt::format("install {}", packages_of(*library))});
    }
    Pipes pipes;
    const bool has_pipes =
        ::pipe2(pipes.errors.data(), O_CLOEXEC) == 0 &&
        (*library != MpiLibrary::mpich || ::pipe2(pipes.output.data(), O_CLOEXEC) == 0);
    const std::vector<std::string> words = command_line(*mpiexec, *library, options);
    const PassedSignals passed;
    const pid_t process = has_pipes ? ::fork() : -1;
    if (process == 0) become(words, pipes);
    if (process < 0) {
        return fail({fmt::format("mpiexec cannot be started: {}", std::strerror(errno)), ""});
    }
    pipes.close_written();
    mpiexec_process = process;
    const WrittenStreams written = pass_messages_on(pipes, console);
    const int status = wait_for(process);
    mpiexec_process = root_process = 0;
    return tell_end(written, status, options, console);
}

}  // namespace cascade
