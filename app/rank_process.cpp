// Runs a script, or the runs of a sweep, on one of several ranks.
#include "app/rank_process.h"

#include "app/exit_status.h"
#include "app/mpiexec_output.h"
#include "app/unexpected.h"
#include "core/counted.h"
#include "core/parallel.h"
#include "core/version.h"
#include "ranks/launcher.h"
#include "ranks/ranks.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>

namespace cascade {
namespace {

/// Returns how long a rank that fails waits for the message of rank 0 before it prints its own
/// message. It waits because usually all ranks fail for the same reason. The time is longer if
/// ranks share a processor, because rank 0 then fails later.
std::chrono::seconds patience() {
    const int sharing = ranks_on_this_machine() / std::max(1, hardware_threads());
    return std::chrono::seconds(std::clamp(2 * sharing, 2, 20));
}

/// Stores the messages of a rank other than rank 0.
class Messages {
public:
    Messages() : file_(::memfd_create("cascade", MFD_CLOEXEC)) {
        if (file_ < 0) file_ = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    }
    ~Messages() { ::close(file_); }
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;

    Console console() const { return {{file_, false, false}, {file_, false, false}}; }
    std::string text() const {
        std::string all(static_cast<std::size_t>(std::max<off_t>(::lseek(file_, 0, SEEK_END), 0)),
                        '\0');
        const ssize_t count = ::pread(file_, all.data(), all.size(), 0);
        all.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        return all;
    }

private:
    int file_;
};

/// A run that was stopped has not failed.
bool is_failure(int status) {
    return status != exit_status::success && status < exit_status::time_limit;
}

Result<void> check_divisible(const Script& script, const RunRequest& request, int ranks) {
    const DomainSettings& domain = script.program->domain;
    if (has_cells(script)) {
        return failure("cells that crawl are not divided among ranks", "one process runs them");
    }
    if (request.session) {
        return failure("a session is played by one process",
                       "an option that changes the script, such as --set, runs the script alone");
    }
    const std::int64_t parts = Ranks::most_parts(domain.grid);
    if (domain.model || domain.surface || parts >= ranks) return {};
    return failure(fmt::format("the {} of the grid cannot be divided among {} ranks",
                               counted(parts, domain.grid.depth > 1 ? "slice" : "row"), ranks),
                   fmt::format("it has room for at most {}", counted(parts, "rank")));
}

/// Divides the cores of this machine among its ranks, unless --threads gives a number.
void share_threads(SimulationOptions& simulation) {
    if (simulation.threads > 0) return;
    simulation.threads = std::max(1, hardware_threads() / ranks_on_this_machine());
}

/// Ends a rank because of a failure that all ranks find. Only rank 0 prints it.
int refuse(Console& console, const Failure& failure, int status) {
    if (launched_rank() != 0) console.leave_answer_to_other();
    if (launched_rank() == 0) console.fail(failure);
    return status;
}

/// Fails if this rank was started with another program or other arguments than rank 0.
Result<void> compare(const Options& options, Ranks& ranks) {
    std::error_code unknown;
    const auto size = std::filesystem::file_size("/proc/self/exe", unknown);
    const auto program = fmt::format("{} {}", version(), unknown ? 0 : size);
    if (auto same = ranks.compare("build of Cascade", program); !same) return same;
    return ranks.compare("command line", fmt::format("{}", fmt::join(options.arguments, "\n")));
}

int run_checked(const Options& options, Console& console, Ranks& ranks, CommandOnRanks& command) {
    try {
        if (auto same = compare(options, ranks); !same) {
            console.fail(same.error());
            return exit_status::failed_run;
        }
        return command(options, console, &ranks);
    } catch (...) {
        return tell_of_exception(console);
    }
}

int run_as_root(const Options& options, Console& console, Ranks& ranks, CommandOnRanks& command) {
    const int status = console.finish(run_checked(options, console, ranks, command));
    if (is_failure(status)) ranks.abort(status);
    return ranks.finish(status);
}

int run_silently(const Options& options, Console& console, Ranks& ranks, CommandOnRanks& command) {
    console.leave_answer_to_other();
    // Only rank 0 reacts to the signals. It ends all ranks together.
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) std::signal(each, SIG_IGN);
    const Messages messages;
    Console silent = messages.console();
    const int status = run_checked(options, silent, ranks, command);
    if (!is_failure(status)) return ranks.finish(status);
    std::this_thread::sleep_for(patience());
    console.say(fmt::format("cascade: error: {} fails:\n{}", name_of_rank(ranks), messages.text()));
    ranks.abort(status);
    return status;
}

}  // namespace

Result<void> share_runs(const Script& script, Ranks& ranks, SweepRequest& request) {
    if (auto same = ranks.compare("script", script.text); !same) return same;
    request.messenger = &ranks.messenger();
    request.ranks_here = ranks_on_this_machine();
    share_threads(request.simulation);
    return {};
}

Result<void> share_steps(const Script& script, Ranks& ranks, RunRequest& request,
                         RunControl& control) {
    if (auto same = ranks.compare("script", script.text); !same) return same;
    if (auto good = check_divisible(script, request, ranks.count()); !good) return good;
    SimulationOptions& simulation = request.simulation;
    simulation.executor = ranks.executor(control.cancel);
    share_threads(simulation);
    if (ranks.is_root()) {
        ranks.tell_slow([&control](const std::string& words) { control.note(words); });
        return {};
    }
    RunRequest steps_alone;
    steps_alone.simulation = simulation;
    steps_alone.resume = request.resume;
    steps_alone.stop_at = request.stop_at;
    steps_alone.picture.detail = request.picture.detail;
    request = std::move(steps_alone);
    // With this flag, the picture at the end of the run is also left out.
    control.hurry = true;
    return {};
}

Result<void> check_readable_by_ranks(const Options& options) {
    const bool reads_input = std::ranges::find(options.scripts, "-") != options.scripts.end();
    if (!reads_input || options.typed) return {};
    return failure("standard input reaches only one of several ranks",
                   "write the script to a file that all ranks can read");
}

int run_as_rank(const Options& options, Console& console, CommandOnRanks& command) {
    const int launched = launched_ranks().value_or(1);
    const int wanted = options.ranks;
    if (wanted > 0 && wanted != launched) {
        return refuse(console,
                      {fmt::format("--ranks {} does not fit the {} ranks that mpiexec has started",
                                   wanted, launched),
                       "leave --ranks out: mpiexec gives the number"},
                      exit_status::wrong_use);
    }
    if (launched == 1) return command(options, console, nullptr);
    if (const auto readable = check_readable_by_ranks(options); !readable) {
        return refuse(console, readable.error(), exit_status::wrong_use);
    }
    if (!options.device.empty()) {
        return refuse(console,
                      {"ranks take steps on threads, so --device cannot be used with mpiexec",
                       "leave --device out, or run one process"},
                      exit_status::wrong_use);
    }
    const auto messenger = choose_mpi(options.mpi).and_then(connect_ranks);
    if (!messenger) return refuse(console, messenger.error(), exit_status::failed_run);
    Ranks ranks(**messenger);
    if (options.ranks > 0) (void)console.error().write(announcement_of_rank(ranks.rank()) + "\n");
    return ranks.is_root() ? run_as_root(options, console, ranks, command)
                           : run_silently(options, console, ranks, command);
}

}  // namespace cascade
