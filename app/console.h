// The two output streams of the program. Results go to standard output, and everything else goes to
// standard error.
#pragma once

#include "core/result.h"

#include <memory>
#include <string>
#include <string_view>

namespace cascade {

class JsonAnswer;
struct Script;

/// Properties of a stream that are found when the program starts and do not change.
struct Stream {
    int descriptor = 1;
    bool is_terminal = false;  ///< Whether the stream is a terminal whose cursor can be moved.
    /// Whether the stream is a terminal and NO_COLOR is not set (no-color.org).
    bool colour = false;

    static Stream of(int descriptor);
    /// Returns the width of the terminal in columns, or 80 if the stream is no terminal.
    int columns() const;
    /// Returns the height of the terminal in lines, or 24 if the stream is no terminal.
    int rows() const;
    /// Writes the whole text. If the reader has closed the pipe, fails with an empty message.
    Result<void> write(std::string_view text) const;
};

class Console {
public:
    Console(Stream out, Stream error) : out_(out), error_(error) {}
    static Console standard() { return {Stream::of(1), Stream::of(2)}; }

    /// From now on, collects all output in a single JSON object, which finish() writes.
    void answer_in_json(std::string_view command);
    /// Drops the output collected for --json, because another process writes the object.
    void leave_answer_to_other() { answer_.reset(); }
    /// Returns the object that collects output for --json, or null without --json.
    JsonAnswer* answer() const { return answer_.get(); }

    const Stream& out() const { return out_; }
    const Stream& error() const { return error_; }

    /// Writes a result. Control characters are replaced, because text may come from a file.
    /// finish() reports a failure to write.
    void print(std::string_view text);
    /// Writes a result unchanged, for other programs. On a terminal, does the same as print().
    void print_exactly(std::string_view text);
    /// Writes text unchanged. It may contain control sequences made by this program, but no text
    /// from a file.
    void draw(std::string_view text);
    /// Writes text to standard error unchanged. Text from a file must have been made printable.
    /// Failures to write are ignored.
    void say(std::string_view text) const;
    /// Writes the diagnostics of a script to standard error.
    void tell(const Script& script) const;
    /// Writes a line to standard error. Control characters are replaced.
    void note(std::string_view message) const;
    /// Writes "cascade: error: message" and, on the next line, the hint. Control characters are
    /// replaced.
    void fail(const Failure& failure) const;
    /// Writes "cascade: warning: message". Control characters are replaced.
    void warn(std::string_view message) const;

    /// Writes the object of --json, if any, and returns the exit status.
    ///
    /// The result is `status`, or the status of a failed run if `status` is success but some output
    /// could not be written. A reader that has closed the pipe (`| head`) does not count as a
    /// failure.
    int finish(int status);

private:
    Stream out_;
    Stream error_;
    bool reader_gone_ = false;
    std::string write_error_;
    std::shared_ptr<JsonAnswer> answer_;
};

}  // namespace cascade
