// A script with the changes that the command line makes to it, and the checked program that
// results.
#pragma once

#include "core/diagnostics.h"
#include "core/granted_files.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// Changes that options make to a script. They are stored in pictures and saved runs.
struct Overrides {
    /// Settings such as "large.ka=1/400", in the order in which the user gave them.
    std::vector<std::string> sets;
    std::optional<GridSize> grid;
    /// Whether --grid has a single number, as in --grid 100. The domain is then a line of cells.
    /// This is not stored in pictures and saved runs.
    bool grid_is_one_number = false;
#define CASCADE_OVERRIDE(type, member, ...) std::optional<type> member;
#include "run/script/override_options.def"

    /// The paths and texts of all files with systems and functions that the script uses and that
    /// could be read. With these texts a picture can be drawn again without the files.
    std::vector<std::pair<std::string, std::string>> used;
    /// The files that may be read. This is not stored in pictures and saved runs.
    ReadAccess reads;
    bool fast = false;  ///< Whether steps are computed with fewer roundings (--fast).
    /// A model that replaces the domain: the path of a file, or the name of a built-in shape.
    std::optional<std::string> model;
    /// Whether the user gave `model` on the command line. If so, the file may be in any folder.
    /// This is not stored in pictures and saved runs.
    bool model_is_asked_for = false;
    /// See DomainSettings::detail. Script::detailed() sets it. It is not stored in pictures and
    /// saved runs.
    std::int64_t detail = 1;
    /// See DomainSettings::coarse. Script::coarser() sets it. It is not stored in pictures and
    /// saved runs.
    std::int64_t coarse = 1;

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// A loaded script. `program` is null if `diagnostics` has errors.
struct Script {
    Script() = default;
    Script(Script&&) = default;
    Script& operator=(Script&&) = default;
    // A script cannot be copied, because its tree refers to its own sources.
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    /// The script's name in messages, such as "examples/leopard.cascade". This is the name that the
    /// user typed or that a picture or saved run stores.
    std::string name;
    /// The file that the user named. It is the script, or a picture or saved run that contains the
    /// script.
    std::filesystem::path file;
    std::string text;
    std::filesystem::path folder;  ///< Relative paths in the script start at this folder.
    Overrides overrides;

    Sources sources;
    Diagnostics diagnostics;
    ast::Script tree;
    std::shared_ptr<const Program> program;

    /// Loads the same script again for smaller cells: along each axis, `times` cells replace one
    /// cell. If there is an error, the result has no program.
    Script detailed(std::int64_t times) const;
    /// Checks the program of this script again for cells that are `times` as wide. Stages with
    /// coarser grids use the result. The script must have no errors.
    Program coarser(std::int64_t times) const;

    /// Writes all diagnostics as text.
    std::string messages(bool colour) const;
    /// Returns the last stage that takes a step, or the last stage if no stage takes a step.
    std::uint32_t final_stage() const;
    /// Returns the number of stages that run. If `until_stage` is given, these are the stages up to
    /// and including that stage. Otherwise they are all stages.
    std::uint32_t stage_count() const;
};

/// Fails if a stage that runs has crawling cells. `what` names the command that cannot run such
/// stages.
Result<void> check_for_fields(const Script& script, std::string_view what);

/// Parses and checks `text`, the files that it uses, its overrides and the picture block. Errors
/// are reported only in the diagnostics of the result.
Script load_script(std::string name, std::string text, std::filesystem::path folder,
                   Overrides overrides = {});

/// A script read from a file. If the file is a PNG that Cascade wrote, the script in it is loaded
/// with its stored overrides, except that members set in `overrides` replace stored members. Fails
/// if the file cannot be read.
struct LoadedFile {
    Script script;
    std::string picture_options;  ///< For a PNG, its PictureRequest as JSON. Empty for a script.
    /// For a sheet of a sweep, the values of its options --vary, in the order of the options.
    std::vector<std::string> varied = {};
    std::string session = {};  ///< For a picture of a session, its log as text. Otherwise empty.
};
Result<LoadedFile> load_script_file(const std::filesystem::path& path, Overrides overrides = {});

/// Returns a hint for scripts without stages: "add 'stage spots: mine { }'". The hint names the
/// last system that the script defines, if the script defines a system.
std::string example_of_stage(const Program& program);

/// Returns the default name of outputs, without an ending: "leopard" for
/// "examples/leopard.cascade". It comes from the file that the user named, even if that file
/// contains another name for the script. If there is no file, it is "cascade".
std::string output_stem(const Script& script);

/// Returns the name of the script for pages, which name files after it. If there is no file, it is
/// made from the name of outputs, such as "cascade.cascade" in place of "<standard input>".
std::string shown_name(const Script& script);

/// Makes a span for messages about an option. The option's value becomes a source text with the
/// name `<--option>`.
Span option_span(Sources& sources, const std::string& option, const std::string& value);

/// Returns the stage with the name `asked`. If no stage has this name and `asked` is a number,
/// returns the stage with that number, counted from 1. Otherwise fails with a list of the names.
Result<std::uint32_t> find_stage(const Program& program, const std::string& asked);

/// Returns the stage that an option names. Adds an error at `span` if there is no such stage. The
/// script must have a program.
std::optional<std::uint32_t> find_stage_of_option(Script& script, const std::string& name,
                                                  Span span);

}  // namespace cascade
