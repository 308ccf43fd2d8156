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
    bool has_error = false;  ///< Whether the declaration had an error, which has been reported.
    /// The type of the value. If a vector consists of three items, `id` is the first item.
    ValueType type = ValueType::number;

    bool is_definition() const { return std::holds_alternative<DefinitionId>(id); }
    ItemId item() const { return std::get<ItemId>(id); }
};

/// The names of one system, including `frozen` and `speed`.
using NameTable = std::unordered_map<std::string, Meaning>;

/// The system of a stage if the system is not known. Names that are read from this system cause no
/// further messages.
inline constexpr SystemId unknown_system(UINT32_MAX);

class FunctionTable;

/// The state of one check: the part of the program that has been checked, and tables for looking up
/// names.
struct Workspace {
    const Program& program;
    Diagnostics& diagnostics;
    IdVector<SystemId, NameTable> names;
    std::unordered_map<std::string, SystemId> systems;      ///< The systems by name.
    std::unordered_map<std::string, std::uint32_t> stages;  ///< The stages by name.
    IdVector<SystemId, IdVector<ItemId, bool>> items_read;
    IdVector<SystemId, IdVector<DefinitionId, bool>> definitions_read;
    std::size_t names_compared = 0;  ///< How many names have been compared to make suggestions.
    /// Whether the grid is on a surface. If so, operators measure lengths along the surface, and
    /// some operators have no meaning.
    bool on_surface = false;
    /// The functions of each script whose expressions have been checked (user_functions.h).
    std::unordered_map<const ast::Script*, std::shared_ptr<const FunctionTable>> functions = {};
    /// How many nodes expansion has made so far.
    std::size_t parts_written = 0;
    /// The call of a function of the script whose body is being checked. Errors in the body refer
    /// to this call.
    std::optional<Span> call = std::nullopt;
    /// For each system, whether one of its statements or indices could not be read. If so, names
    /// that seem to be missing are not reported, because the unread statement may declare them.
    IdVector<SystemId, bool> incomplete = {};
    /// Indices that have no values because of errors that have been reported. Declarations that use
    /// these indices are ignored.
    std::vector<std::string_view> invalid_indices = {};
    Program* draft = nullptr;  ///< The program that is being checked; null if it is finished.
    /// For each stage, whether its system is a block of cells.
    std::vector<bool> cell_stages = {};
    /// The functions of cells (lang/library/library.h); null if the script has no cells.
    const ast::Script* cell_functions = nullptr;
    NameUses* uses = nullptr;     ///< Receives the uses of names, for editors; may be null.
    bool lengths_grow = false;    ///< Whether lengths of the domain may change in a stage.
    ScriptUnits units = {};       ///< The units in which the script computes.
    MeasuredSpans measured = {};  ///< The parts of the script that have a unit.
};

/// Whether the name is a value that every crawling cell has. In a script with crawling cells,
/// functions can read this value.
bool is_of_each_cell(std::string_view name);

/// In which kind of place an expression is written. The place determines which names and functions
/// the expression may contain.
enum class Context : std::uint8_t {
    value,     ///< name: e
    rate,      ///< name' = e, or a definition
    bound,     ///< name >= e
    picture,   ///< A value in a picture.
    position,  ///< The position of a point on a surface.
    mask,      ///< The condition that decides which cells belong to the domain.
    constant,  ///< A number that the checker needs: iterations, the size of the grid, …
    shape,     ///< A definition in a `shape` block.
};

/// An index and its value, such as `i` = 2 in the second member of `u[i]: e`.
struct IndexValue {
    std::string_view name;
    std::int64_t value = 0;
};

struct Scope {
    Context context = Context::value;
    /// The system to which names without a prefix refer. If such names have no meaning,
    /// `unknown_system`.
    SystemId system = unknown_system;
    /// The stage that contains the expression. nullopt if a system contains it.
    std::optional<std::uint32_t> stage;
    std::uint32_t last_stage = 0;  ///< In a picture, the last stage that may be read.
    /// If the expression is a constant, the name of the constant in messages.
    std::string_view subject;
    /// Whether the expression is the value of a side. Such a value may read t and step.
    bool is_side = false;
    /// Whether the expression describes a surface. Such an expression may read arrays by `field`.
    bool reads_volumes = false;
    /// The values of the indices in a statement about a family.
    std::vector<IndexValue> indices = {};
    /// Whether the constant is a length of the domain. Such a constant may read t.
    bool is_length = false;
};

/// The names of a system.
NameTable names_of(const System& system);
const Meaning* find(const NameTable& table, std::string_view name);
/// The species with this name. nullopt if there is none.
std::optional<ItemId> find_species(const Workspace& work, SystemId system, std::string_view name);
/// The species with this name or, if a definition has this name and is a number, the definition.
/// nullopt if there is neither.
std::optional<SideSubject> find_subject(const Workspace& work, SystemId system,
                                        std::string_view name);

// The following functions return the node to which a name refers. If there is no such node, they
// return nullopt, and report an error unless an error has already been reported for this name.
std::optional<Node> resolve_bare(Workspace& work, const Scope& scope, std::string_view name,
                                 Span span);
std::optional<Node> resolve_bracketed(Workspace& work, const Scope& scope, const ast::Word& name,
                                      Span span);
std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span);
std::optional<Node> resolve_rate(Workspace& work, const Scope& scope, const ast::Word& name,
                                 Span span);

/// Whether vectors have three components and are vectors in space, as in systems of crawling cells
/// and in shapes.
bool is_of_cells(const Workspace& work, const Scope& scope);
/// The node of a value that only crawling cells have. Reports an error if the value has no meaning
/// in this scope.
std::optional<Node> resolve_cell_value(Workspace& work, const Scope& scope, CellValue value,
                                       Span span);

/// Whether the item of an earlier stage of crawling cells can be read in this scope. Otherwise
/// reports an error. Only a stage that continues with the same cells can read their values, because
/// cells crawl, divide and die.
bool knows_cells(Workspace& work, const Scope& scope, StageItem item, Span span);

/// The stage to which a name in a block of cells refers, such as the stage `coat` in `coat.b`. Each
/// cell reads the value of b at the cell's own position. Reports an error if there is no such
/// stage. check_cell_stage() checks that the stage runs before the stages of the cells.
std::optional<std::uint32_t> find_sensed_stage(Workspace& work, const ast::Qualified& qualified);

/// Whether a part of the system could not be read.
bool is_incomplete(const Workspace& work, SystemId system);

/// Whether there are so many errors or compared names that no more suggestions are made. This
/// limits the time that it takes to check a script with many errors.
bool is_hopeless(const Workspace& work);

/// A suggestion such as "did you mean 'beta'?". "" if there is none.
std::string did_you_mean(Workspace& work, std::string_view name,
                         const std::vector<std::string>& candidates);

/// A hint about a word that is not a setting in this context: what to write in Cascade, the block
/// to which the word belongs, or the most similar candidate.
std::string hint_about(Workspace& work, std::string_view word, WordContext context,
                       const std::vector<std::string>& candidates);

/// The advice, with the number of `value` in place of the number in its example: "write 'speed:
/// 0.5'" for `dt: 0.5`.
std::string with_number(std::string advice, const ast::Expr& value);

/// Whether the system has a family called `name`, such as u for u[1], u[2], …
bool has_family(const System& system, std::string_view name);

/// The text of an error, with its hint.
struct Explanation {
    std::string message, hint;
};
/// Explains why a system lacks a name. nullopt unless the name is a missing member of a family, a
/// family without an index, or an index without a value.
std::optional<Explanation> explain_family(Workspace& work, const System& system,
                                          std::string_view name);

/// Reports a name that is not a species of the system, unless a part of the system that could not
/// be read may declare the species.
void report_not_species(Workspace& work, SystemId system, std::string_view name, Span span);

/// The error for an index that is read in a place where it has no value.
Explanation index_without_value(std::string_view index);

/// The species and parameters of a system in alphabetical order.
std::vector<std::string> quantity_names(const System& system);

/// A list such as "a, b, beta" of at most two dozen names.
std::string list_names(const std::vector<std::string>& names);

/// A text such as "a -> b -> a". A long cycle is cut after its first members.
std::string describe_cycle(const std::vector<std::string>& names);

/// If the body of a script's own function is being checked, adds a note that points to the call.
void add_call(const Workspace& work, Diagnostic& diagnostic);

/// Reports an error in an expression. Adds `note` if it is not empty, and also the note of
/// add_call().
void report(Workspace& work, Span span, std::string message, std::string hint,
            std::string note = "");

/// Reports the second use of a name, with a note at its first use.
void report_twice(Workspace& work, Span second, Span first, std::string message);

/// Marks the species, parameters and definitions that a formula reads.
void mark_reads(Workspace& work, const Formula& formula, SystemId system);

}  // namespace cascade::checking
