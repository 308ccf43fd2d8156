// Runs another program, whose input this program writes.
#pragma once

#include "core/descriptor.h"
#include "core/result.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace cascade {

/// Whether the path is a file that may be executed.
bool is_program(const std::filesystem::path& path);

/// How long to wait for a process after this program must end. Before that, the wait is unlimited.
struct Patience {
    const std::atomic<bool>& is_over;  ///< Set when this program must end.
    /// The longest wait if the process neither takes input nor computes.
    std::chrono::seconds while_idle{5};
    /// The longest wait if the process computes but takes no input.
    std::chrono::seconds while_busy{60};
};

/// A process that is started without a shell, in a separate process group, so that signals of the
/// terminal do not reach it. Its standard output is discarded, but its errors are recorded. The
/// destructor ends the process and its children.
class ChildProcess {
public:
    struct End {
        bool is_good = false;  ///< Whether the process read all input and then ended with status 0.
        /// The last line that the process wrote to standard error. If there is none, a description
        /// of how it ended.
        std::string last_words;
    };

    static Result<std::unique_ptr<ChildProcess>> start(const std::filesystem::path& program,
                                                       const std::vector<std::string>& arguments,
                                                       Patience patience);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes to the standard input of the process. Returns false if the process no longer reads.
    bool write(std::string_view bytes);
    /// Closes the input of the process and waits until the process ends. Kills the process when the
    /// limits of Patience are exceeded.
    End end();

private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    using Clock = std::chrono::steady_clock;

    explicit ChildProcess(Patience patience) : patience_(patience) {}
    void begin_waiting() { taken_at_ = active_at_ = Clock::now(); }
    bool is_hopeless();
    void give_up();

    Patience patience_;
    /// The times at which the process last read bytes and last computed.
    Clock::time_point taken_at_, active_at_;
    std::chrono::nanoseconds computed_{0};  ///< The processor time of the process at active_at_.
    bool is_given_up_ = false;
    bool has_refused_ = false;  ///< Whether the process has not read everything that was written.
    pid_t process_ = -1;
    std::optional<Descriptor> input_;
    std::unique_ptr<std::FILE, CloseFile> errors_;
};

}  // namespace cascade
