// Writes a whole log to a temporary file, renames it, and appends later changes. The file is locked
// while its session lasts. A file without a lock was left by a session that did not end in the
// usual way.
#include "app/session_file.h"

#include "core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace cascade {
namespace {

constexpr int most_files = 100;
/// If a file has at least this size, and at least twice the size that the log needs, the log is
/// written again without undone changes.
constexpr std::uint64_t usual_bytes = std::uint64_t{1} << 20;
/// The shortest time between two entries while steps are taken and nothing is changed.
constexpr auto between_places = std::chrono::seconds(1);
constexpr std::string_view mark = ".unsaved";

/// Removes the mark of unsaved sessions and the text after it from a stem. So if a session
/// continues an unsaved session, the files of both have the same stem.
std::string first_stem(std::string stem) {
    const std::size_t begin = stem.find(mark);
    if (begin != std::string::npos && begin > 0) stem.resize(begin);
    return stem;
}

std::filesystem::path numbered(const std::filesystem::path& folder, const std::string& stem,
                               int number) {
    const std::string count = number == 1 ? "" : fmt::format("-{}", number);
    return (folder / fmt::format("{}{}{}.session", stem, mark, count)).lexically_normal();
}

Failure cannot_be_kept(const std::filesystem::path& path, const std::string& why) {
    return {fmt::format("this session is not kept in a file: {}: {}", path.string(), why),
            "save it before it ends"};
}

}  // namespace

SessionFile::SessionFile(std::filesystem::path folder, std::string stem, std::string command,
                         bool has_file)
    : folder_(std::move(folder)),
      stem_(first_stem(std::move(stem))),
      command_(std::move(command)),
      has_file_(has_file) {}

std::shared_ptr<SessionFile> SessionFile::of(LiveRun& run, const std::string& stem,
                                             std::string command, bool has_file) {
    std::shared_ptr<SessionFile> file(
        new SessionFile(run.script().folder, stem, std::move(command), has_file));
    run.tell([file](const SessionLog& log, RunPlace now, bool is_step) {
        file->write(log, now, is_step);
    });
    return file;
}

SessionFile::~SessionFile() {
    if (!path_.empty() && !is_left_) ::unlink(path_.c_str());
}

void SessionFile::leave() {
    const std::lock_guard lock(mutex_);
    is_left_ = true;
}

std::optional<Result<std::string>> SessionFile::news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, std::nullopt);
}

void SessionFile::write(const SessionLog& log, RunPlace now, bool is_step) {
    const std::lock_guard lock(mutex_);
    if (has_failed_ || (path_.empty() && has_file_ && log.changes.empty())) return;
    const auto time = std::chrono::steady_clock::now();
    if (is_step && !path_.empty() && time - written_at_ < between_places) return;
    written_at_ = time;
    if (path_.empty()) {
        if (auto made = create(); !made) return give_up(made.error());
    }
    if (bytes_ > most_bytes_) log_.begin_again();
    append(log_.lines(log, now));
}

/// Creates a file with a name that no other session uses.
Result<void> SessionFile::create() {
    for (int number = 1;; ++number) {
        const auto path = numbered(folder_, stem_, number);
        const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
        if (file.is_open()) {
            path_ = path;
            news_ = fmt::format(
                "the session is saved in {0} until it ends; if the program is killed, "
                "'cascade {1} {0}' continues it",
                path.string(), command_);
            return {};
        }
        if (errno != EEXIST || number == most_files) {
            return tl::unexpected(cannot_be_kept(path, std::strerror(errno)));
        }
    }
}

void SessionFile::append(const OpenLog::Lines& lines) {
    if (lines.replaces_all) {
        if (auto done = replace(lines.text); !done) give_up(done.error());
        return;
    }
    if (const int error = write_all(*file_, lines.text); error != 0) {
        return give_up(cannot_be_kept(path_, std::strerror(error)));
    }
    bytes_ += lines.text.size();
}

Result<void> SessionFile::replace(const std::string& text) {
    if (auto done = write_file(path_, text); !done) return done;
    file_ = std::make_unique<Descriptor>(
        ::open(path_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC));
    if (!file_->is_open()) return tl::unexpected(cannot_be_kept(path_, std::strerror(errno)));
    (void)::flock(file_->number(), LOCK_EX | LOCK_NB);
    bytes_ = text.size();
    most_bytes_ = std::max(2 * bytes_, usual_bytes);
    return {};
}

/// Stops writing. The lines so far remain in the file, so that the session up to them can be
/// repeated.
void SessionFile::give_up(Failure why) {
    has_failed_ = true;
    news_ = tl::unexpected(std::move(why));
}

std::vector<std::filesystem::path> SessionFile::left_in(const std::filesystem::path& folder,
                                                        const std::string& stem) {
    std::vector<std::filesystem::path> left;
    for (int number = 1; number <= most_files; ++number) {
        const auto path = numbered(folder, first_stem(stem), number);
        const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
        if (!file.is_open()) break;
        if (::flock(file.number(), LOCK_SH | LOCK_NB) == 0) left.push_back(path);
    }
    return left;
}

void tell_news(SessionFile& file, const Console& console) {
    const auto news = file.news();
    if (!news) return;
    if (*news) return console.note(**news);
    console.warn(fmt::format("{}; {}", news->error().message, news->error().hint));
}

void tell_of_files_left(const std::filesystem::path& folder, const std::string& stem,
                        const std::filesystem::path& file, std::string_view command,
                        const Console& console) {
    for (const auto& left : SessionFile::left_in(folder, stem)) {
        if (left.lexically_normal() == file.lexically_normal()) continue;
        console.note(
            fmt::format("{0} holds a session whose program was killed; 'cascade {1} "
                        "{0}' continues it",
                        left.string(), command));
    }
}

}  // namespace cascade
