// The two streams of the program: results go to standard output, all talk to standard error.
#pragma once

#include "core/result.h"

#include <string>
#include <string_view>

namespace cascade {

/// What is known of a stream when the program starts.
struct Stream {
    int descriptor = 1;
    bool is_terminal = false;  ///< A terminal that can move its cursor.
    bool colour = false;       ///< A terminal, and the user has not set NO_COLOR (no-color.org).

    static Stream of(int descriptor);
    /// Columns of the terminal; 80 where there is none.
    int columns() const;
    /// All of it, or why not.
    Result<void> write(std::string_view text) const;
};

class Console {
public:
    Console(Stream out, Stream error) : out_(out), error_(error) {}
    static Console standard() { return {Stream::of(1), Stream::of(2)}; }

    const Stream& out() const { return out_; }
    const Stream& error() const { return error_; }

    /// A result. What a terminal would obey is replaced: parts of it may come from any file. Where
    /// it cannot be written the fault is remembered for finish().
    void print(std::string_view text);
    /// The same, but as it is where no terminal shows it: what other programs read byte for byte.
    void print_exactly(std::string_view text);
    /// The same with our own sequences for terminals in it, and nothing from a file.
    void draw(std::string_view text);
    /// A text for people, as it is: nothing from a file that has not been made printable. Where
    /// nobody listens it is lost without complaint.
    void say(std::string_view text) const;
    /// A line for people, made printable.
    void note(std::string_view message) const;
    /// "cascade: error: message", and the hint below it, made printable.
    void fail(const Failure& failure) const;
    /// "cascade: warning: message", made printable.
    void warn(std::string_view message) const;

    /// `status`, or that of a failed run if a result could not be written and `status` is good. A
    /// reader who has gone away (`| head`) is no fault.
    int finish(int status) const;

private:
    Stream out_;
    Stream error_;
    bool reader_gone_ = false;
    std::string fault_;
};

}  // namespace cascade
