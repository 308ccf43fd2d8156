// Writes with write(2), which reports a closed pipe or a full disk.
#include "app/console.h"

#include "app/exit_status.h"
#include "app/json_answer.h"
#include "core/printable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sys/ioctl.h>
#include <unistd.h>

namespace cascade {

namespace {

constexpr int usual_columns = 80, usual_rows = 24;

bool is_set(const char* name) {
    const char* const value = std::getenv(name);
    return value && *value;
}

}  // namespace

Stream Stream::of(int descriptor) {
    const char* const terminal = std::getenv("TERM");
    Stream stream;
    stream.descriptor = descriptor;
    stream.is_terminal =
        isatty(descriptor) == 1 && terminal && std::string_view(terminal) != "dumb";
    stream.colour = stream.is_terminal && !is_set("NO_COLOR");
    return stream;
}

int Stream::columns() const {
    winsize size = {};
    if (is_terminal && ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        return size.ws_col;
    }
    return usual_columns;
}

int Stream::rows() const {
    winsize size = {};
    if (is_terminal && ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_row > 0) {
        return size.ws_row;
    }
    return usual_rows;
}

Result<void> Stream::write(std::string_view text) const {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure(errno == EPIPE ? "" : std::strerror(errno));
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return {};
}

void Console::answer_in_json(std::string_view command) {
    answer_ = std::make_shared<JsonAnswer>(command);
}

void Console::print(std::string_view text) { draw(printable_lines(text)); }

void Console::print_exactly(std::string_view text) {
    if (out_.is_terminal) print(text);
    else draw(text);
}

void Console::draw(std::string_view text) {
    if (answer_) return answer_->print(text);
    if (reader_gone_ || !write_error_.empty()) return;
    const auto done = out_.write(text);
    if (done) return;
    reader_gone_ = done.error().message.empty();
    write_error_ = done.error().message;
}

void Console::say(std::string_view text) const {
    if (!answer_) (void)error_.write(text);
}

void Console::tell(const Script& script) const {
    if (answer_) return answer_->add(script);
    say(script.messages(error_.colour));
}

void Console::note(std::string_view message) const {
    if (answer_) return answer_->add("note", message);
    say(printable(message) + "\n");
}

void Console::fail(const Failure& failure) const {
    if (answer_) return answer_->add("error", failure.message, failure.hint);
    const auto in_colour = [&](std::string_view colour) {
        return error_.colour ? colour : std::string_view();
    };
    std::string text = fmt::format("cascade: {}error:{} {}\n", in_colour("\x1b[1;31m"),
                                   in_colour("\x1b[0m"), printable(failure.message));
    if (!failure.hint.empty()) {
        text += fmt::format("{}note:{} {}\n", in_colour("\x1b[1;36m"), in_colour("\x1b[0m"),
                            printable(failure.hint));
    }
    say(text);
}

void Console::warn(std::string_view message) const {
    if (answer_) return answer_->add("warning", message);
    const std::string text = printable(message);
    say(error_.colour ? fmt::format("cascade: \x1b[1;35mwarning:\x1b[0m {}\n", text)
                      : fmt::format("cascade: warning: {}\n", text));
}

int Console::finish(int status) {
    if (answer_) {
        const std::string text = answer_->text(status);
        answer_.reset();
        draw(text);
    }
    if (write_error_.empty()) return status;
    fail({fmt::format("standard output cannot be written: {}", write_error_), ""});
    return status == exit_status::success ? exit_status::failed_run : status;
}

}  // namespace cascade
