// The statements of a system together with the statements that it inherits. Used to print
// equations.
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace cascade {

/// A statement and the script that contains its expressions.
struct SaidStatement {
    const ast::Script* script = nullptr;
    const Sources* sources = nullptr;
    const ast::Statement* statement = nullptr;
    /// `doc` is the statement whose doc comment applies: `statement` itself or, if it has no doc
    /// comment, the inherited statement that it replaces. Null if neither has one. `range` is the
    /// same for the range.
    const ast::Statement* doc = nullptr;
    const ast::Statement* range = nullptr;
    const ast::Script* range_script = nullptr;
    const Sources* range_sources = nullptr;
};

/// The subject of a statement. In a derived system, a statement replaces the inherited statement
/// with the same subject, unless it is a term that is added to a rate.
std::string subject_of(const ast::Statement& statement);

/// The `system` blocks of a script, by name.
using SystemBlocks = std::unordered_map<std::string_view, const ast::Block*>;
SystemBlocks system_blocks(const ast::Script& script);

/// The statements of a system of a checked script or of the library. The statements of the system's
/// bases come first. If a derived system replaces a statement of its base, only the replacement is
/// included.
class SystemStatements {
public:
    /// `blocks` must be system_blocks(script).
    SystemStatements(const ast::Script& script, const Sources& sources, const SystemBlocks& blocks,
                     std::string_view system);

    /// Whether the system exists.
    bool found() const { return found_; }
    const std::vector<SaidStatement>& all() const { return statements_; }
    /// Whether the system is a block of cells.
    bool is_cells() const { return is_cells_; }
    /// The system's own doc comment; may be empty.
    const std::string& doc() const { return doc_; }
    /// Whether the system has a rate of `name`, which must not have an index.
    bool is_species(std::string_view name) const { return species_.contains(name); }

private:
    struct LibraryScript {
        Sources sources;
        ast::Script script;
        SystemBlocks blocks;
    };
    struct FoundBlock {
        const ast::Script* script = nullptr;
        const Sources* sources = nullptr;
        const SystemBlocks* blocks = nullptr;  ///< The system blocks of `script`.
        const ast::Block* block = nullptr;
    };
    /// Finds the block of a system in the script `beside.script`.
    static FoundBlock find_block(FoundBlock beside, std::string_view system);
    FoundBlock find_in_library(std::string_view system);
    void derive(const FoundBlock& found);

    std::deque<LibraryScript> library_;
    std::vector<SaidStatement> statements_;
    std::unordered_set<std::string_view> species_;
    std::string doc_;
    bool found_ = false, is_cells_ = false;
};

}  // namespace cascade
