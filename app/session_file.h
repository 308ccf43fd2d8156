// The file in which the log of a session is kept while it goes on.
//
// Each change is appended when it is made, so that nothing is lost if the terminal is closed or the
// program is killed. spec/session.md says where the file is and when it is removed.
#pragma once

#include "app/console.h"
#include "core/descriptor.h"
#include "core/result.h"
#include "run/session/live_run.h"
#include "run/session/open_log.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Made with the first change, or step: `STEM.unsaved.session`, or with a number if there is one.
/// Functions may be called from any thread.
class SessionFile {
public:
    /// Keeps the log of a run. `stem` is that of its outputs; `command` plays the file again. With
    /// `has_file` the script is in a file, and before the first change nothing can be lost.
    static std::shared_ptr<SessionFile> of(LiveRun& run, const std::string& stem,
                                           std::string command, bool has_file);
    /// Removes the file: the user has ended the session.
    ~SessionFile();
    SessionFile(const SessionFile&) = delete;
    SessionFile& operator=(const SessionFile&) = delete;

    /// The destructor leaves the file where it is.
    void leave();

    /// What the user should know since the last call: where the file is, or, as a failure, that
    /// there is none.
    std::optional<Result<std::string>> news();

    /// The files that sessions left which were ended from outside.
    static std::vector<std::filesystem::path> left_in(const std::filesystem::path& folder,
                                                      const std::string& stem);

private:
    SessionFile(std::filesystem::path folder, std::string stem, std::string command, bool has_file);
    void write(const SessionLog& log, RunPlace now, bool is_step);
    void append(const OpenLog::Lines& lines);
    Result<void> create();
    Result<void> replace(const std::string& text);
    void give_up(Failure why);

    std::mutex mutex_;
    const std::filesystem::path folder_;
    const std::string stem_, command_;
    const bool has_file_;
    std::filesystem::path path_;  ///< Empty before the first change.
    OpenLog log_;
    std::unique_ptr<Descriptor> file_;
    std::uint64_t bytes_ = 0, most_bytes_ = 0;
    std::chrono::steady_clock::time_point written_at_;
    bool has_failed_ = false, is_left_ = false;
    std::optional<Result<std::string>> news_;
};

/// Prints the news of a file.
void tell_news(SessionFile& file, const Console& console);

/// Says which files sessions of a script have left, but for `file`, which is played now.
void tell_of_files_left(const std::filesystem::path& folder, const std::string& stem,
                        const std::filesystem::path& file, std::string_view command,
                        const Console& console);

}  // namespace cascade
