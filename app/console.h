// The two streams of the program: results on standard output, everything else on standard error.
#pragma once

#include "core/result.h"

#include <memory>
#include <string>
#include <string_view>

namespace cascade {

class JsonAnswer;
struct Script;

/// What is known about a stream when the program starts.
struct Stream {
    int descriptor = 1;
    bool is_terminal = false;  ///< A terminal that can move its cursor.
    bool colour = false;       ///< A terminal, and the user has not set NO_COLOR (no-color.org).

    static Stream of(int descriptor);
    /// Width of the terminal in columns; 80 if there is none.
    int columns() const;
    /// Its height in lines; 24 if there is none.
    int rows() const;
    /// Writes all of it. The message of the failure is empty if the reader has closed the pipe.
    Result<void> write(std::string_view text) const;
};

class Console {
public:
    Console(Stream out, Stream error) : out_(out), error_(error) {}
    static Console standard() { return {Stream::of(1), Stream::of(2)}; }

    /// From now on all output is collected in one answer, which finish() writes.
    void answer_in_json(std::string_view command);
    /// Null unless the output is JSON.
    JsonAnswer* answer() const { return answer_.get(); }

    const Stream& out() const { return out_; }
    const Stream& error() const { return error_; }

    /// Writes a result. Control characters are replaced, since parts of it may come from a file. An
    /// error is remembered for finish().
    void print(std::string_view text);
    /// On a terminal as print() does; else writes the bytes as they are, for other programs to
    /// read.
    void print_exactly(std::string_view text);
    /// Writes as it is: may hold our own control sequences, but no text from a file.
    void draw(std::string_view text);
    /// Writes to standard error as it is: text from a file must have been made printable. Errors
    /// are ignored.
    void say(std::string_view text) const;
    /// Writes the diagnostics of a script to standard error.
    void tell(const Script& script) const;
    /// Writes a line to standard error, made printable.
    void note(std::string_view message) const;
    /// Writes "cascade: error: message" and the hint on a line below, made printable.
    void fail(const Failure& failure) const;
    /// Writes "cascade: warning: message", made printable.
    void warn(std::string_view message) const;

    /// Writes the answer, if the output is JSON.
    ///
    /// Returns `status`, or that of a failed run if that is good but a result could not be written.
    /// A reader that has closed the pipe (`| head`) is not an error.
    int finish(int status);

private:
    Stream out_;
    Stream error_;
    bool reader_gone_ = false;
    std::string write_error_;
    std::shared_ptr<JsonAnswer> answer_;
};

}  // namespace cascade
