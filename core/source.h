// Source texts and locations in them.
//
// Every text in which a user can make a mistake is a Source: the script, a built-in system, an
// expression from the command line, a line typed at the prompt. A Span is a range of one of them.
// Later stages store only spans. Drawing a message computes the line and the column.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The index of a source in its Sources.
using SourceId = std::uint32_t;

/// The bytes [begin, end) of one source. If `begin == end`, the span is a position between two
/// characters.
struct Span {
    SourceId source = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend bool operator==(const Span&, const Span&) = default;
};

/// The smallest span that covers both spans, which must be in one source.
Span join(Span first, Span last);

/// A line and a column as shown to a user. Both count from 1, and columns count code points, not
/// bytes.
struct Location {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// A text with its name: a path, or a substitute such as "<command line>".
class Source {
public:
    Source(std::string name, std::string text);

    const std::string& name() const { return name_; }
    std::string_view text() const { return text_; }

    /// The line and column of a byte offset (clamped to the size of the text).
    Location locate(std::uint32_t offset) const;

    /// A line without its line end, where `line` counts from 1. Empty after the last line.
    std::string_view line(std::uint32_t line) const;

private:
    std::string name_;
    std::string text_;
    std::vector<std::uint32_t> line_starts_;
};

/// All texts of one program. Adding a text never moves the others, so string views into them stay
/// valid.
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
