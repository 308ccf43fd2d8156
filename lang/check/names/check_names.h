// Name resolution (internal to the checker).
//
// Inside a system every name is the system's own. Inside a stage a bare name refers to the previous
// stage, `[name]` to this one and `large.name` to an earlier one. In a picture bare names refer to
// the stage that is shown.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/name_uses.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
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

/// What a name of a system refers to.
struct Meaning {
    std::variant<ItemId, DefinitionId> id;
    bool has_error = false;  ///< Its declaration had an error, which has been reported.
    /// A vector of items has the id of the first of three.
    ValueType type = ValueType::number;

    bool is_definition() const { return std::holds_alternative<DefinitionId>(id); }
    ItemId item() const { return std::get<ItemId>(id); }
};

/// The names of one system, `frozen` and `speed` included.
using NameTable = std::unordered_map<std::string, Meaning>;

/// The system of a stage with an unknown system; reading from it causes no further messages.
inline constexpr SystemId unknown_system(UINT32_MAX);

class FunctionTable;

/// State shared by one check: the program so far, and tables to look names up.
struct Workspace {
    const Program& program;
    Diagnostics& diagnostics;
    IdVector<SystemId, NameTable> names;
    std::unordered_map<std::string, SystemId> systems;      ///< By name.
    std::unordered_map<std::string, std::uint32_t> stages;  ///< By name.
    IdVector<SystemId, IdVector<ItemId, bool>> items_read;
    IdVector<SystemId, IdVector<DefinitionId, bool>> definitions_read;
    std::size_t names_compared = 0;  ///< For suggestions, so far.
    /// The grid lies on a surface, along which operators measure; some have no meaning there.
    bool on_surface = false;
    /// The functions of each script whose expressions have been checked; see user_functions.h.
    std::unordered_map<const ast::Script*, std::shared_ptr<const FunctionTable>> functions = {};
    /// Nodes that calls and families have been expanded to so far.
    std::size_t parts_written = 0;
    /// The call of a script's own function that is being checked; errors refer to it.
    std::optional<Span> call = std::nullopt;
    /// True if one of a system's statements or indices could not be read. A name that it seems to
    /// lack may be declared there, so it is not reported.
    IdVector<SystemId, bool> incomplete = {};
    /// Indices without values, which have been reported; declarations that use them are ignored.
    std::vector<std::string_view> invalid_indices = {};
    Program* draft = nullptr;  ///< The program under construction; null if it is finished.
    std::vector<bool> cell_stages = {};  ///< By stage: is its system a block of cells?
    /// The functions of cells (lang/library/library.h); null if there are no cells.
    const ast::Script* cell_functions = nullptr;
    NameUses* uses = nullptr;  ///< Receives what names refer to; null if nobody asks.
};

/// Is it a name of which every cell that crawls has a value? A function of a script with such cells
/// can read it.
bool is_of_each_cell(std::string_view name);

/// Where an expression stands; decides which names and functions it may read.
enum class Context : std::uint8_t {
    value,     ///< name: e
    rate,      ///< name' = e and definitions
    bound,     ///< name >= e
    picture,   ///< what a picture shows
    position,  ///< the position of a surface's points
    mask,      ///< which cells the domain has
    constant,  ///< a number known while checking: iterations, the size of the grid, …
    shape,     ///< a definition of a `shape` block
};

/// An index and its value, such as `i` = 2 in the second member of `u[i]: e`.
struct IndexValue {
    std::string_view name;
    std::int64_t value = 0;
};

struct Scope {
    Context context = Context::value;
    /// The system whose names are read without a prefix; unknown where none has a meaning.
    SystemId system = unknown_system;
    std::optional<std::uint32_t> stage;  ///< Empty inside a system.
    std::uint32_t last_stage = 0;        ///< In pictures: the last stage that can be read.
    std::string_view subject;            ///< In constants: the name of the value in messages.
    bool is_side = false;        ///< For a value of a side, which may read t, step and definitions.
    bool reads_volumes = false;  ///< For a surface: it may read arrays by `field`.
    std::vector<IndexValue> indices = {};  ///< Of a statement of a family.
};

/// The table of a system's names.
NameTable names_of(const System& system);
const Meaning* find(const NameTable& table, std::string_view name);
/// The species of a name; nothing if it is none.
std::optional<ItemId> find_species(const Workspace& work, SystemId system, std::string_view name);
/// The species or definition of a name, a number; nothing if it is none.
std::optional<SideSubject> find_subject(const Workspace& work, SystemId system,
                                        std::string_view name);

// Each returns the node that a name refers to. If there is none, reports an error (unless that has
// happened already) and returns nothing.
std::optional<Node> resolve_bare(Workspace& work, const Scope& scope, std::string_view name,
                                 Span span);
std::optional<Node> resolve_bracketed(Workspace& work, const Scope& scope, const ast::Word& name,
                                      Span span);
std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span);
std::optional<Node> resolve_rate(Workspace& work, const Scope& scope, const ast::Word& name,
                                 Span span);

/// True where vectors are those of space: in systems of cells that crawl, and in shapes.
bool is_of_cells(const Workspace& work, const Scope& scope);
/// The node of such a value in a system of cells, not in constants; reports an error if it has none
/// here.
std::optional<Node> resolve_cell_value(Workspace& work, const Scope& scope, CellValue value,
                                       Span span);

/// Can the item of an earlier stage of cells be read here? Cells crawl, divide and die, so that
/// only the stage that goes on with them knows their values. Reports an error and returns false if
/// not.
bool knows_cells(Workspace& work, const Scope& scope, StageItem item, Span span);

/// The stage of `coat.b` in a block of cells, which senses it at the place of each cell; reports an
/// error if there is none. check_cell_stage() knows whether it runs before the stages of the cells.
std::optional<std::uint32_t> find_sensed_stage(Workspace& work, const ast::Qualified& qualified);

/// True if a part of the system could not be read.
bool is_incomplete(const Workspace& work, SystemId system);

/// True if the number of errors or compared names is so large that no more suggestions are made,
/// which bounds the time to refuse a script.
bool is_hopeless(const Workspace& work);

/// "did you mean 'beta'?", or "".
std::string did_you_mean(Workspace& work, std::string_view name,
                         const std::vector<std::string>& candidates);

/// A hint for a word that is not a setting here: its name in this context, the block that it
/// belongs to, or the nearest of the candidates.
std::string hint_about(Workspace& work, std::string_view word, WordContext context,
                       const std::vector<std::string>& candidates);

/// True if `name` is that of a family of the system, such as u for u[1], u[2], …
bool has_family(const System& system, std::string_view name);

/// An error message and a hint.
struct Explanation {
    std::string message, hint;
};
/// Explains a name that a system lacks if that has to do with families: a missing member, a family
/// without an index, an index without a value.
std::optional<Explanation> explain_family(Workspace& work, const System& system,
                                          std::string_view name);

/// Reports a name that is not a species of the system, unless a part that could not be read may
/// declare it.
void report_not_species(Workspace& work, SystemId system, std::string_view name, Span span);

/// The error of an index that is read where it has no value.
Explanation index_without_value(std::string_view index);

/// The species and parameters of a system in alphabetical order.
std::vector<std::string> quantity_names(const System& system);

/// "a, b, beta": at most two dozen of them.
std::string list_names(const std::vector<std::string>& names);

/// "a -> b -> a"; of a long cycle only the first members.
std::string describe_cycle(const std::vector<std::string>& names);

/// Adds a note on the call of the script's own function that is being checked, if there is one.
void add_call(const Workspace& work, Diagnostic& diagnostic);

/// Reports an error in an expression, with a note (if not empty) and one on such a call.
void report(Workspace& work, Span span, std::string message, std::string hint,
            std::string note = "");

/// Reports the second use of a name, with a note at the first.
void report_twice(Workspace& work, Span second, Span first, std::string message);

/// Marks the species, parameters and definitions that a formula reads.
void mark_reads(Workspace& work, const Formula& formula, SystemId system);

}  // namespace cascade::checking
