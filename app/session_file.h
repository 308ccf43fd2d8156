// The file that stores the log of a session until the session ends.
//
// Each change is appended when it is made, so that no change is lost if the terminal is closed or
// the program is killed. spec/session.md says where the file is and when it is removed.
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

/// The file is created by the first change or step. Its name is `STEM.unsaved.session`. A number is
/// added if that name is taken. Any thread may call the functions.
class SessionFile {
public:
    /// Stores the log of a run. `stem` is the beginning of the names of the run's outputs.
    /// `command` is the command that can repeat the session from the file. If `has_file` is true,
    /// the script itself is in a file, so there is nothing to store before the first change.
    static std::shared_ptr<SessionFile> of(LiveRun& run, const std::string& stem,
                                           std::string command, bool has_file);
    /// Removes the file, because the user has ended the session.
    ~SessionFile();
    SessionFile(const SessionFile&) = delete;
    SessionFile& operator=(const SessionFile&) = delete;

    /// Makes the destructor leave the file on the disk.
    void leave();

    /// Returns what the user must be told since the last call, if anything: the path of the new
    /// file, or a failure with the reason why there is no file.
    std::optional<Result<std::string>> news();

    /// Returns the files of sessions that were not ended by their users.
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
    std::filesystem::path path_;  ///< Empty until the file has been created.
    OpenLog log_;
    std::unique_ptr<Descriptor> file_;
    std::uint64_t bytes_ = 0, most_bytes_ = 0;
    std::chrono::steady_clock::time_point written_at_;
    bool has_failed_ = false, is_left_ = false;
    std::optional<Result<std::string>> news_;
};

/// Prints the news of a file (SessionFile::news()), if there is any.
void tell_news(SessionFile& file, const Console& console);

/// Prints which files earlier sessions of a script have left, except `file`, from which the present
/// session is repeated.
void tell_of_files_left(const std::filesystem::path& folder, const std::string& stem,
                        const std::filesystem::path& file, std::string_view command,
                        const Console& console);

}  // namespace cascade
