// Reads scripts with expectations in their comments. README.md describes the notation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade::test {

/// A message about the text of a script. In an expected message `text` is a pattern.
struct Message {
    std::string kind;                  ///< error, warning or note.
    std::string source;                ///< "<--set>", or empty for the script itself.
    std::size_t line = 0, column = 0;  ///< From 1, or 0 if there is no place.
    std::string text;                  ///< "message | hint".
};

/// The notation of an expected message: "expect error 3:5: text".
std::string print(const Message& message);

/// Two expressions and how they compare, in all cells or in one.
struct ExpectedValue {
    std::string left, relation, right;
    std::optional<double> tolerance;
    std::optional<std::array<std::int64_t, 3>> cell;
    std::string written;  ///< The whole expectation, for messages of failures.
};

/// One script of a file with all its expectations.
struct ScriptCase {
    std::string name;  ///< Empty if the file has no cases.
    std::string text;  ///< The text has the same line numbers as in the file.
    std::vector<std::string> sets;
    bool runs_once = false, is_single = true, is_double = true, is_interpreted = true;
    std::vector<Message> messages;      ///< Expected messages about the text.
    std::vector<std::string> warnings;  ///< Patterns for warnings of the run.
    /// Patterns. Without a value, remarks are ignored.
    std::optional<std::vector<std::string>> remarks;
    std::optional<std::string> failure;  ///< A pattern.
    std::vector<ExpectedValue> values;
    std::vector<std::string> same_as;  ///< Cases with the same result.
    bool is_sound = false;             ///< Whether it says `expect sound`.
    bool is_quiet = false;             ///< Whether it says `expect quiet`.
    std::size_t expectations = 0;

    /// True if the case expects nothing from a run.
    bool is_only_checked() const;
};

struct ScriptFile {
    std::vector<ScriptCase> cases;
    std::vector<std::string> errors;  ///< Errors in the notation: "3: there is no …".
    const ScriptCase* find(const std::string& name) const;
};

ScriptFile read_script_file(const std::string& text);

/// Whether a text matches a pattern, in which '…' matches anything.
bool matches(const std::string& text, const std::string& pattern);

}  // namespace cascade::test
