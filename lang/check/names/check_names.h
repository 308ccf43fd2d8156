// Resolves names (internal to the checker).
//
// Inside a system every name belongs to this system. Inside a stage, a bare name refers to the
// previous stage, `[name]` to this stage, and `large.name` to an earlier stage called large. In a
// picture, a bare name refers to the stage that is shown.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/name_uses.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/script_units.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

namespace cascade::checking {

/// The item or definition to which a name of a system refers.
struct Meaning {
    std::variant<ItemId, DefinitionId> id;
    bool has_error = false;  ///< The declaration had an error, which has been reported.
    /// The type. For a vector that consists of three items, the id names the first item.
    ValueType type = ValueType::number;

    bool is_definition() const { return std::holds_alternative<DefinitionId>(id); }
    ItemId item() const { return std::get<ItemId>(id); }
};

/// The names of one system, including `frozen` and `speed`.
using NameTable = std::unordered_map<std::string, Meaning>;

/// The system of a stage whose system is unknown. Names that are read from it cause no further
/// messages.
inline constexpr SystemId unknown_system(UINT32_MAX);

class FunctionTable;

/// The state of one check: the program so far, and tables for looking up names.
struct Workspace {
    const Program& program;
    Diagnostics& diagnostics;
    IdVector<SystemId, NameTable> names;
    std::unordered_map<std::string, SystemId> systems;      ///< By name.
    std::unordered_map<std::string, std::uint32_t> stages;  ///< By name.
    IdVector<SystemId, IdVector<ItemId, bool>> items_read;
    IdVector<SystemId, IdVector<DefinitionId, bool>> definitions_read;
    std::size_t names_compared = 0;  ///< The number of names that have been compared to make
                                     ///< suggestions.
    /// Whether the grid is on a surface. Operators then measure lengths along the surface, and some
    /// operators have no meaning.
    bool on_surface = false;
    /// The functions of each script whose expressions have been checked (user_functions.h).
    std::unordered_map<const ast::Script*, std::shared_ptr<const FunctionTable>> functions = {};
    /// The number of nodes made by expansion so far.
    std::size_t parts_written = 0;
    /// The call of a script's own function that is being checked. Errors refer to it.
    std::optional<Span> call = std::nullopt;
    /// For each system, whether one of its statements or indices could not be read. Names that seem
    /// to be missing are then not reported, because they may be declared in that statement.
    IdVector<SystemId, bool> incomplete = {};
    /// Indices without values. They have been reported. Declarations that use them are ignored.
    std::vector<std::string_view> invalid_indices = {};
    Program* draft = nullptr;  ///< The program under construction; null if it is finished.
    std::vector<bool> cell_stages = {};  ///< For each stage, whether its system is a block of
                                         ///< cells.
    /// The functions of cells (lang/library/library.h); null if the script has no cells.
    const ast::Script* cell_functions = nullptr;
    NameUses* uses = nullptr;     ///< Receives the uses of names, for editors; may be null.
    bool lengths_grow = false;    ///< Whether lengths of the domain may change in a stage.
    ScriptUnits units = {};       ///< The units in which the script computes.
    MeasuredSpans measured = {};  ///< The numbers of the script that have a unit.
};

/// Whether the name is a value that every crawling cell has. A function of a script with such cells
/// can read it.
bool is_of_each_cell(std::string_view name);

/// The kind of place where an expression is written. This determines which names and functions the
/// expression may contain.
enum class Context : std::uint8_t {
    value,     ///< name: e
    rate,      ///< name' = e and definitions
    bound,     ///< name >= e
    picture,   ///< The values in a picture.
    position,  ///< The position of a point on a surface.
    mask,      ///< The condition for cells to belong to the domain.
    constant,  ///< A number that the checker needs: iterations, the size of the grid, …
    shape,     ///< A definition of a `shape` block.
};

/// An index and its value, such as `i` = 2 in the second member of `u[i]: e`.
struct IndexValue {
    std::string_view name;
    std::int64_t value = 0;
};

struct Scope {
    Context context = Context::value;
    /// The system to which names without a prefix refer. Unknown if such names have no meaning.
    SystemId system = unknown_system;
    std::optional<std::uint32_t> stage;  ///< Empty inside a system.
    std::uint32_t last_stage = 0;        ///< In pictures: the last stage that may be read.
    std::string_view subject;            ///< For constants: the name of the constant in messages.
    bool is_side = false;  ///< Whether the expression is the value of a side, which may read t and
                           ///< step.
    bool reads_volumes = false;  ///< Whether the expression describes a surface, which may read
                                 ///< arrays by `field`.
    std::vector<IndexValue> indices = {};  ///< The indices of a statement of a family.
    bool is_length = false;  ///< Whether the constant is a length of the domain, which may read t.
};

/// The names of a system.
NameTable names_of(const System& system);
const Meaning* find(const NameTable& table, std::string_view name);
/// The species of this name. Empty if there is none.
std::optional<ItemId> find_species(const Workspace& work, SystemId system, std::string_view name);
/// The species of this name, or the definition of this name if it is a number. Empty if there is
/// neither.
std::optional<SideSubject> find_subject(const Workspace& work, SystemId system,
                                        std::string_view name);

// Each function returns the node to which a name refers. If there is none, it returns nothing, and
// reports an error unless an error for this name has already been reported.
std::optional<Node> resolve_bare(Workspace& work, const Scope& scope, std::string_view name,
                                 Span span);
std::optional<Node> resolve_bracketed(Workspace& work, const Scope& scope, const ast::Word& name,
                                      Span span);
std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span);
std::optional<Node> resolve_rate(Workspace& work, const Scope& scope, const ast::Word& name,
                                 Span span);

/// Whether vectors are vectors in space with three components, as in systems of cells that crawl
/// and in shapes.
bool is_of_cells(const Workspace& work, const Scope& scope);
/// The node of a value that only cells that crawl have. Reports an error if the value has no
/// meaning in this scope.
std::optional<Node> resolve_cell_value(Workspace& work, const Scope& scope, CellValue value,
                                       Span span);

/// Whether the item of an earlier stage of cells can be read in this scope. Cells crawl, divide and
/// die, so only a stage that continues with the same cells can read their values. Otherwise reports
/// an error and returns false.
bool knows_cells(Workspace& work, const Scope& scope, StageItem item, Span span);

/// The stage to which a name in a block of cells refers, such as the stage `coat` in `coat.b`. Each
/// cell senses the value of b at the cell's position. Reports an error if there is no such stage.
/// check_cell_stage() checks that this stage runs before the stages of the cells.
std::optional<std::uint32_t> find_sensed_stage(Workspace& work, const ast::Qualified& qualified);

/// Whether a part of the system could not be read.
bool is_incomplete(const Workspace& work, SystemId system);

/// Whether there are so many errors or compared names that no more suggestions are made. This
/// limits the time that the check of a wrong script takes.
bool is_hopeless(const Workspace& work);

/// A suggestion such as "did you mean 'beta'?", or "".
std::string did_you_mean(Workspace& work, std::string_view name,
                         const std::vector<std::string>& candidates);

/// A hint for a word that is not a setting in this context: the name that Cascade uses instead, the
/// block to which the word belongs, or the most similar candidate.
std::string hint_about(Workspace& work, std::string_view word, WordContext context,
                       const std::vector<std::string>& candidates);

/// The advice with the number `value` in place of the example's number: "write 'speed: 0.5'" for
/// `dt: 0.5`.
std::string with_number(std::string advice, const ast::Expr& value);

/// Whether the system has a family called `name`, such as u for u[1], u[2], …
bool has_family(const System& system, std::string_view name);

/// The text of an error, with its hint.
struct Explanation {
    std::string message, hint;
};
/// Explains why a system lacks a name, if the name is a missing member of a family, a family
/// without an index, or an index without a value.
std::optional<Explanation> explain_family(Workspace& work, const System& system,
                                          std::string_view name);

/// Reports a name that is not a species of the system, unless the species may be declared in a part
/// that could not be read.
void report_not_species(Workspace& work, SystemId system, std::string_view name, Span span);

/// The error for an index that is read where it has no value.
Explanation index_without_value(std::string_view index);

/// The species and parameters of a system in alphabetical order.
std::vector<std::string> quantity_names(const System& system);

/// A list such as "a, b, beta" of at most two dozen names.
std::string list_names(const std::vector<std::string>& names);

/// A text such as "a -> b -> a". A long cycle is cut after its first members.
std::string describe_cycle(const std::vector<std::string>& names);

/// If a call of the script's own function is being checked, adds a note that points to the call.
void add_call(const Workspace& work, Diagnostic& diagnostic);

/// Reports an error in an expression. Adds `note` if it is not empty, and the note of add_call().
void report(Workspace& work, Span span, std::string message, std::string hint,
            std::string note = "");

/// Reports the second use of a name, with a note at its first use.
void report_twice(Workspace& work, Span second, Span first, std::string message);

/// Marks the species, parameters and definitions that a formula reads.
void mark_reads(Workspace& work, const Formula& formula, SystemId system);

}  // namespace cascade::checking
