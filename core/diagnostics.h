// Diagnostics: errors and warnings about a user's text, stored as objects.
//
// The stages of the front end add to a Diagnostics, continue and never print. Only
// render_diagnostics.cpp contains the layout of messages.
#pragma once

#include "core/source.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace cascade {

enum class Severity { error, warning };

/// A second location, or a remark without a location, that explains a diagnostic.
struct Note {
    std::optional<Span> span;
    std::string message;
};

/// One error or warning. `message` is a clause without a full stop. `hint` (may be empty) says what
/// to write instead and is drawn after the underlined words.
struct Diagnostic {
    Severity severity = Severity::error;
    Span span;
    std::string message;
    std::string hint;
    std::vector<Note> notes;
};

/// The diagnostics of one program. A message that repeats at the same location is stored once. At
/// most `most_kept` of each severity are stored, because a text that is not a script causes very
/// many. Further diagnostics are only counted.
class Diagnostics {
public:
    static constexpr std::size_t most_kept = 10'000;

    void error(Span span, std::string message, std::string hint = "");
    void warning(Span span, std::string message, std::string hint = "");
    void add(Diagnostic diagnostic);

    bool has_errors() const { return error_count_ > 0; }
    bool empty() const { return list_.empty(); }
    std::size_t error_count() const { return error_count_; }
    std::size_t warning_count() const { return warning_count_; }

    /// The diagnostics, sorted by source and position.
    std::vector<Diagnostic> sorted() const;

private:
    std::vector<Diagnostic> list_;
    std::set<std::tuple<Severity, SourceId, std::uint32_t, std::uint32_t, std::string>> seen_;
    std::size_t error_count_ = 0;
    std::size_t warning_count_ = 0;
};

struct RenderStyle {
    bool colour = false;  ///< ANSI colours, for a terminal.
    /// The largest number of diagnostics to draw. A last line gives the number of the others.
    std::size_t most = 50;
};

/// Draws one diagnostic:
///
///     leopard.cascade:17:13: error: 'betta' is not a parameter of turing_spots
///        17 |       beta: betta
///           |             ^~~~~ did you mean 'beta'?
///     note: bare names read the previous stage 'large' (turing_spots: a, b, beta)
///
/// A long line is cut to the part around the span. Control characters are replaced, and tabs keep
/// their width.
std::string render(const Diagnostic& diagnostic, const Sources& sources, const RenderStyle& style);

/// Draws all diagnostics, sorted. Each drawing ends with a line end.
std::string render(const Diagnostics& diagnostics, const Sources& sources,
                   const RenderStyle& style);

}  // namespace cascade
