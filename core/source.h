// Source texts and places in them.
//
// Every text that a user can make a mistake in is a Source: the script, a built-in system, an
// expression given on the command line, a line typed at the prompt. A Span names a stretch of one
// of them and is all that later stages keep; line, column and the line itself are looked up only
// when a message is drawn.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Position of a source in its Sources.
using SourceId = std::uint32_t;

/// The bytes [begin, end) of one source. `begin == end` marks a place between two characters.
struct Span {
    SourceId source = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend bool operator==(const Span&, const Span&) = default;
};

/// The smallest span that covers both; they must be of one source.
Span join(Span first, Span last);

/// A place as a person counts it: both from 1, columns in characters (code points), not bytes.
struct Location {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// One text with its name (a path, or what stands for one, such as "<command line>").
class Source {
public:
    Source(std::string name, std::string text);

    const std::string& name() const { return name_; }
    std::string_view text() const { return text_; }

    /// Line and column of a byte offset (clamped to the text's size).
    Location locate(std::uint32_t offset) const;

    /// A line without its line end; `line` counts from 1. Empty beyond the last line.
    std::string_view line(std::uint32_t line) const;

private:
    std::string name_;
    std::string text_;
    std::vector<std::uint32_t> line_starts_;
};

/// All texts of one program. Adding never moves the others: string views into them stay valid.
class Sources {
public:
    SourceId add(std::string name, std::string text);
    const Source& operator[](SourceId id) const { return sources_[id]; }
    std::string_view text(Span span) const;
    std::size_t size() const { return sources_.size(); }

private:
    std::deque<Source> sources_;
};

}  // namespace cascade
