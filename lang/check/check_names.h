// Names: what each stands for where it is read (internal to the checker).
//
// Inside a system every name is the system's own. Inside a stage a bare name is read from the
// previous stage, `[name]` from this one and `large.name` from an earlier one. In a picture bare
// names are those of the stage that is shown.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cascade::checking {

/// What a name of a system stands for.
struct Meaning {
    bool is_definition = false;
    std::uint32_t index = 0;  ///< Of the item or of the definition.
    bool is_faulty = false;   ///< It was to be declared but could not: all is said about it.
};

/// The names of one system, `frozen` and `speed` included.
using NameTable = std::unordered_map<std::string, Meaning>;

/// A stage whose system is not known: whatever reads it stays silent.
inline constexpr std::uint32_t unknown_system = UINT32_MAX;

class FunctionTable;

/// What one check shares: the program as far as it is known, and look-ups into it.
struct Workspace {
    const Program& program;
    Diagnostics& diagnostics;
    std::vector<NameTable> names;                            ///< By system.
    std::unordered_map<std::string, std::uint32_t> systems;  ///< By name.
    std::unordered_map<std::string, std::uint32_t> stages;   ///< By name.
    std::vector<std::vector<bool>> items_read;               ///< By system and item.
    std::vector<std::vector<bool>> definitions_read;         ///< By system and definition.
    std::size_t names_compared = 0;                          ///< For hints, so far.
    /// Operators measure on a surface, where not all of them have a meaning.
    bool on_surface = false;
    /// The functions of each script whose expressions were checked; see user_functions.h.
    std::unordered_map<const ast::Script*, std::shared_ptr<const FunctionTable>> functions = {};
    /// Parts of expressions that calls and families were written out to, so far.
    std::size_t parts_written = 0;
    /// The call of a user's function that is being checked: what is wrong is wrong there.
    std::optional<Span> call = std::nullopt;
    /// By system: statements of it or an index could not be read. What it seems to lack may stand
    /// there, so nothing is said of it.
    std::vector<bool> incomplete = {};
    /// Indices that have no values, with a message: what they were to number is passed over.
    std::vector<std::string_view> faulty_indices = {};
    Program* draft = nullptr;  ///< The program while it is made; null for views of one that is.
};

/// Where an expression stands: it decides which names and functions it may read.
enum class Context : std::uint8_t {
    value,     ///< name: e
    rate,      ///< name' = e and definitions
    bound,     ///< name >= e
    picture,   ///< what a picture shows
    position,  ///< where a point of a surface lies
    mask,      ///< which cells the domain has
    constant,  ///< one number that is known now: iterations, the size of the grid, …
};

/// An index with its value, as `i` is 2 in the second statement that `u[i]: e` stands for.
struct IndexValue {
    std::string_view name;
    std::int64_t value = 0;
};

struct Scope {
    Context context = Context::value;
    std::uint32_t system = 0;            ///< Whose names are one's own.
    std::optional<std::uint32_t> stage;  ///< Empty inside a system.
    std::uint32_t last_stage = 0;        ///< In pictures: the last stage that can be read.
    std::string_view subject;            ///< In constants: what is to be one number.
    bool knows_time = false;             ///< Values of sides may depend on t and step.
    std::optional<IndexValue> index = std::nullopt;  ///< Of the statement, if it is of a family.
};

/// Whether the language gives a word a meaning of its own, so that nobody can declare it.
enum class Reserved : std::uint8_t { no, setting, builtin };
Reserved reserved(std::string_view name);

/// The table of a system's names.
NameTable names_of(const System& system);
const Meaning* find(const NameTable& table, std::string_view name);

// Each returns the node that a name stands for, or gives a message (unless one has been given
// already) and returns nothing.
std::optional<Node> resolve_bare(Workspace& work, const Scope& scope, std::string_view name,
                                 Span span);
std::optional<Node> resolve_bracketed(Workspace& work, const Scope& scope, const ast::Word& name,
                                      Span span);
std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span);
std::optional<Node> resolve_rate(Workspace& work, const Scope& scope, const ast::Word& name,
                                 Span span);

/// Has a system parts that could not be read?
bool is_incomplete(const Workspace& work, std::uint32_t system);

/// True when so many faults or names have been met that no more hints are worth their time:
/// messages are then short, so that no text takes long to refuse.
bool is_hopeless(const Workspace& work);

/// "did you mean 'beta'?", or nothing.
std::string did_you_mean(Workspace& work, std::string_view name,
                         const std::vector<std::string>& candidates);

/// What to write in place of a word that is no setting where it stands: what it is called here, the
/// block that it belongs to, or the nearest of the candidates.
std::string hint_about(Workspace& work, std::string_view word, WordContext context,
                       const std::vector<std::string>& candidates);

/// Is this the name of a family of the system, the u of u[1], u[2], …?
bool has_family(const System& system, std::string_view name);

/// What is wrong with a name, and what to write.
struct Explanation {
    std::string message, hint;
};
/// Why a name that a system lacks is none of its own, where that has to do with families: a member
/// that is not there, a family without an index, an index that has no value.
std::optional<Explanation> explain_family(Workspace& work, const System& system,
                                          std::string_view name);

/// An index that is read where it has no value.
Explanation index_without_value(std::string_view index);

/// The species and parameters of a system in the order of the alphabet.
std::vector<std::string> quantity_names(const System& system);

/// "a, b, beta": at most two dozen of them.
std::string list_names(const std::vector<std::string>& names);

/// Where a call of the script's own function is checked: the fault is a fault of that call.
void add_call(const Workspace& work, Diagnostic& diagnostic);

/// Adds a second use of a name: an error at the second with a note at the first.
void report_twice(Workspace& work, Span second, Span first, std::string message);

/// Remembers which species, parameters and definitions a formula reads.
void mark_reads(Workspace& work, const Formula& formula, std::uint32_t system);

}  // namespace cascade::checking
