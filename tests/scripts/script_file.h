// Scripts with expectations in their comments: how they are read. README.md describes the notation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade::test {

/// A message about the text of a script. Of an expected one `text` is a pattern.
struct Message {
    std::string kind;                  ///< error, warning or note.
    std::string source;                ///< "<--set>"; empty: the script itself.
    std::size_t line = 0, column = 0;  ///< From 1; 0: nowhere.
    std::string text;                  ///< "message | hint".
};

/// "expect error 3:5: text", as the notation has it.
std::string print(const Message& message);

/// Two expressions and how they compare, in all cells or in one.
struct ExpectedValue {
    std::string left, relation, right;
    std::optional<double> tolerance;
    std::optional<std::array<std::int64_t, 3>> cell;
    std::string written;  ///< All of it, for failures.
};

/// One script of a file and all that is said about it.
struct ScriptCase {
    std::string name;  ///< Empty where the file is one script.
    std::string text;  ///< On the lines that it has in the file.
    std::vector<std::string> sets;
    bool runs_once = false, is_single = true, is_double = true, is_interpreted = true;
    std::vector<Message> messages;                    ///< About the text.
    std::vector<std::string> warnings;                ///< Patterns, of the run.
    std::optional<std::vector<std::string>> remarks;  ///< Patterns; none: nothing is expected.
    std::optional<std::string> failure;               ///< A pattern.
    std::vector<ExpectedValue> values;
    std::vector<std::string> same_as;  ///< Names of cases.
    bool is_sound = false;             ///< `expect sound`.
    bool is_quiet = false;             ///< `expect quiet`.
    std::size_t expectations = 0;

    /// Is there nothing to be seen of a run?
    bool is_only_checked() const;
};

struct ScriptFile {
    std::vector<ScriptCase> cases;
    std::vector<std::string> errors;  ///< Of the notation: "3: there is no …".
    const ScriptCase* find(const std::string& name) const;
};

ScriptFile read_script_file(const std::string& text);

/// Does a text match a pattern, in which '…' matches anything?
bool matches(const std::string& text, const std::string& pattern);

}  // namespace cascade::test
