// A text that is open in the editor, and its checked script.
#pragma once

#include "lang/service/name_index.h"
#include "lsp/lines.h"
#include "run/script/script.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade::lsp {

/// Returns the paths and texts of the other open files.
using OpenFiles = std::function<std::vector<std::pair<std::filesystem::path, std::string>>()>;

class Document {
public:
    /// A text without a path, such as a new document, names files relative to the current folder.
    /// If a script uses a file that is open, the file's text comes from the editor instead of the
    /// disk.
    Document(std::string uri, std::string text, ColumnUnit unit, OpenFiles open);

    const std::string& uri() const { return uri_; }
    const std::optional<std::filesystem::path>& path() const { return path_; }
    const std::string& text() const { return text_; }
    const Lines& lines() const { return lines_; }
    ColumnUnit unit() const { return unit_; }

    void set_text(std::string text);
    /// Replaces the text between two positions. They may be in either order.
    void replace(Position from, Position to, std::string_view text);

    /// Makes the next call that needs the script check it again.
    void forget();
    /// The script of the present text. It has no program if it has errors.
    Script& script();
    /// The script of the last text that had no errors. Null if there was none.
    std::shared_ptr<const Script> last_correct();
    /// The program of last_correct(), or an empty one.
    const Program& program();
    /// The names of the present text.
    const NameIndex& names();

    /// The version number that the editor has given to the text, if any.
    std::optional<std::int64_t> version;
    /// Whether the editor has not yet received the diagnostics of the present text.
    bool is_changed = true;

private:
    std::shared_ptr<Script> load();

    std::string uri_, text_;
    std::optional<std::filesystem::path> path_;
    ColumnUnit unit_;
    Lines lines_;
    OpenFiles open_;
    std::shared_ptr<Script> script_, correct_;
    std::unique_ptr<NameIndex> names_;
};

/// The source of the document's own text in its script.
inline constexpr SourceId own_source = 0;

}  // namespace cascade::lsp
