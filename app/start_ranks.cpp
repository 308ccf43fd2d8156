// Runs mpiexec as a child process in a separate process group, so that Ctrl-C in a terminal
// reaches only this process. mpiexec would kill the ranks a second later.
#include "app/exit_status.h"
#include "app/mpiexec_output.h"
#include "app/rank_process.h"
#include "core/printable.h"
#include "ranks/launcher.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
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

/// The first signal ends the run after a batch of steps. The second one ends it at once.
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

/// The launcher of the library for which this program was built, or else of any library.
std::optional<std::filesystem::path> find_mpiexec(bool is_open_mpi) {
    const char* const path = std::getenv("PATH");
    for (const char* const name : {is_open_mpi ? "mpiexec.openmpi" : "mpiexec.mpich", "mpiexec"}) {
        std::istringstream folders(path ? path : "");
        for (std::string folder; std::getline(folders, folder, ':');) {
            const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name;
            if (::access(file.c_str(), X_OK) == 0) return file;
        }
    }
    return std::nullopt;
}

std::vector<std::string> command_line(const std::filesystem::path& mpiexec, bool is_open_mpi,
                                      const Options& options) {
    std::error_code unknown;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    std::vector<std::string> words = {mpiexec.string()};
    if (is_open_mpi) words.insert(words.end(), {"--oversubscribe", "--bind-to", "none"});
    words.insert(words.end(), {"-n", std::to_string(options.ranks), program.string()});
    words.insert(words.end(), options.arguments.begin(), options.arguments.end());
    return words;
}

/// In the child process: becomes mpiexec.
[[noreturn]] void become(std::vector<std::string> words, int errors) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(errors, STDERR_FILENO);
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

/// Prints the messages of ranks until mpiexec and all ranks have closed the pipe.
MpiexecOutput pass_messages_on(int errors, const Console& console) {
    MpiexecOutput output;
    std::string text;
    std::array<char, 4096> buffer{};
    while (true) {
        const ssize_t count = ::read(errors, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        text.append(buffer.data(), static_cast<std::size_t>(count));
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;) {
            const std::string line = text.substr(begin, end - begin);
            if (output.takes(line)) console.say(line + "\n");
            remember_root(output);
            begin = end + 1;
        }
        text.erase(0, begin);
    }
    if (!text.empty() && output.takes(text)) console.say(text);
    return output;
}

int wait_for(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : exit_status::signal_base + WTERMSIG(status);
}

/// Explains a failure, if no rank has done so, and returns the exit status.
int tell_end(const MpiexecOutput& output, int status, const Options& options,
             const Console& console) {
    if (status == exit_status::success || output.has_error()) return status;
    if (interrupts > 0) {
        if (interrupts > 1) console.say("cascade: ended at once; nothing has been written\n");
        return exit_status::signal_base + SIGINT;
    }
    if (!output.killed().empty() && options.command == Command::sweep) {
        console.fail({output.killed() + ", so all ranks have ended",
                      "the same command goes on with the runs that are missing"});
        return exit_status::failed_run;
    }
    if (!output.killed().empty()) {
        const bool saves = !options.run.save.empty() && options.run.checkpoint_seconds > 0;
        console.fail({output.killed() + ", so all ranks have ended",
                      saves ? fmt::format("'cascade run --resume {}' goes on from the last save, "
                                          "with any number of ranks",
                                          options.run.save.string())
                            : "with --save and --checkpoint such a run can be resumed"});
        return exit_status::failed_run;
    }
    if (status == exit_status::time_limit) return status;
    if (!output.explanations().empty()) console.say(output.explanations());
    console.fail({fmt::format("mpiexec has ended with status {}", status), ""});
    return exit_status::failed_run;
}

}  // namespace

int start_ranks(const Options& options, Console& console) {
    const auto engine = mpi_of_this_build();
    if (!engine) {
        console.fail(engine.error());
        return exit_status::failed_run;
    }
    const bool is_open_mpi = *engine == "Open MPI";
    const auto mpiexec = find_mpiexec(is_open_mpi);
    if (!mpiexec) {
        console.fail({"mpiexec, which starts the ranks, is not installed",
                      fmt::format("install {}", is_open_mpi ? "openmpi-bin" : "mpich")});
        return exit_status::failed_run;
    }
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
        console.fail({fmt::format("mpiexec cannot be started: {}", std::strerror(errno)), ""});
        return exit_status::failed_run;
    }
    const std::vector<std::string> words = command_line(*mpiexec, is_open_mpi, options);
    const PassedSignals passed;
    const pid_t process = ::fork();
    if (process == 0) become(words, pipe[1]);
    ::close(pipe[1]);
    if (process < 0) {
        console.fail({fmt::format("mpiexec cannot be started: {}", std::strerror(errno)), ""});
        ::close(pipe[0]);
        return exit_status::failed_run;
    }
    mpiexec_process = process;
    const MpiexecOutput output = pass_messages_on(pipe[0], console);
    ::close(pipe[0]);
    const int status = wait_for(process);
    mpiexec_process = root_process = 0;
    return tell_end(output, status, options, console);
}

}  // namespace cascade
