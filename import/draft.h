// The parts of a script that an importer makes, and the text that is written from them.
#pragma once

#include "import/formula.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cascade::importing {

/// A file that is written beside the script.
struct FileBeside {
    std::string name;
    std::string bytes;
};

/// The parts of a script with one system and one stage. Statements contain no line ends.
struct Draft {
    /// The comment at the top of the script: the source and its description.
    std::vector<std::string> about;
    std::vector<std::string> functions;
    std::vector<std::string> parameters, starts, definitions, rates, sides;
    std::vector<std::string> domain;
    std::vector<std::string> stage;  ///< The stage's statements except `speed`.
    double speed = 1;                ///< 0 if the solver chooses its steps.
    /// Whether the script computes differences between cells by other formulas than the source. The
    /// steps of the source may then be too long.
    bool has_other_differences = false;
    /// Whether shorter steps leave the equations the same. False if a formula computes values of
    /// the next step.
    bool may_shorten = true;
    /// Whether the file has no pattern at the start because its program waits for a click.
    bool waits_for_click = false;
    /// The differences between script and source. They are written as comments and shown to the
    /// user.
    std::vector<std::string> remarks;
    std::vector<FileBeside> files;
};

/// The text of the script in the standard form.
std::string write_script(const Draft& draft);

/// Whether a statement reads or declares the name.
bool has_word(std::string_view statement, std::string_view name);

/// Turns a text into one line for a comment, without control characters and repeated blanks.
std::string plain_line(std::string_view text);

/// Chooses names that a script may declare. A name that the language uses gets an underscore.
class FreeNames {
public:
    /// Returns the name under which the script declares `foreign`. Different names stay different.
    std::string declare(std::string_view foreign);
    /// Returns a name similar to `wanted` that is not used yet.
    std::string fresh(std::string_view wanted);

private:
    std::set<std::string> used_;
};

}  // namespace cascade::importing
