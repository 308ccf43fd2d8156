// Another program that reads what this one writes.
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

/// True for a file that may be started.
bool is_program(const std::filesystem::path& path);

/// How long to wait for a process once this program must end. Until then it may take any time.
struct Patience {
    const std::atomic<bool>& is_over;     ///< Set when this program must end.
    std::chrono::seconds while_idle{5};   ///< It neither takes input nor computes.
    std::chrono::seconds while_busy{60};  ///< It takes no input.
};

/// Started without a shell, in a process group of its own, so that signals of the terminal do not
/// reach it. Its output is dropped, except errors. The destructor ends it and its children.
class ChildProcess {
public:
    struct End {
        bool is_good = false;    ///< It exited with status 0 after reading everything.
        std::string last_words;  ///< Its last line of errors, or else how it ended.
    };

    static Result<std::unique_ptr<ChildProcess>> start(const std::filesystem::path& program,
                                                       const std::vector<std::string>& arguments,
                                                       Patience patience);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes to its standard input; false if it no longer reads.
    bool write(std::string_view bytes);
    /// Closes its input and waits for its end. Ends it if patience runs out.
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
    Clock::time_point taken_at_, active_at_;  ///< When it last took bytes, or computed.
    std::chrono::nanoseconds computed_{0};    ///< Processor time at active_at_.
    bool is_given_up_ = false;
    bool has_refused_ = false;  ///< It has not taken what was written.
    pid_t process_ = -1;
    std::optional<Descriptor> input_;
    std::unique_ptr<std::FILE, CloseFile> errors_;
};

}  // namespace cascade
