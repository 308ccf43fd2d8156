// A script as requested: its text, the changes of the command line, and the resulting checked
// program.
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

/// Changes from outside the script. They are stored in pictures and saved runs.
struct Overrides {
    std::vector<std::string> sets;  ///< "large.ka=1/400", in order.
    std::optional<GridSize> grid;
    bool grid_is_one_number = false;  ///< As in --grid 100, which is a line of cells. Not stored.
#define CASCADE_OVERRIDE(type, member, ...) std::optional<type> member;
#include "run/script/override_options.def"

    /// The files that the script uses, as (path, text), as far as they have been read, so that a
    /// picture can be drawn again without them.
    std::vector<std::pair<std::string, std::string>> used;
    ReadAccess reads;   ///< Not stored.
    bool fast = false;  ///< Steps are computed with fewer roundings.
    /// The domain becomes this model: a file, or the name of a shape.
    std::optional<std::string> model;
    bool model_is_asked_for = false;  ///< By the user, so the file may be anywhere. Not stored.
    std::int64_t detail = 1;          ///< As in DomainSettings, of Script::detailed(). Not stored.
    std::int64_t coarse = 1;          ///< Likewise, of Script::coarser(). Not stored.

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// A loaded script. `program` is empty if `diagnostics` has errors.
struct Script {
    Script() = default;
    Script(Script&&) = default;
    Script& operator=(Script&&) = default;
    Script(const Script&) = delete;  // The tree holds views into this script's own sources.
    Script& operator=(const Script&) = delete;

    /// The name in messages: as the user typed it, "examples/leopard.cascade", or as stored in a
    /// picture or a saved run.
    std::string name;
    /// The file that the user named: the script, or the picture or saved run that it was found in.
    std::filesystem::path file;
    std::string text;
    std::filesystem::path folder;  ///< Paths in the script are relative to it.
    Overrides overrides;

    Sources sources;
    Diagnostics diagnostics;
    ast::Script tree;
    std::shared_ptr<const Program> program;

    /// The same script, loaded again for cells that are this many times as short along each axis;
    /// its program is null if there is an error.
    Script detailed(std::int64_t times) const;
    /// The program of the same script, checked again for cells that are this many times as wide, as
    /// those of its stages may be. The script has no errors.
    Program coarser(std::int64_t times) const;

    /// All diagnostics, formatted.
    std::string messages(bool colour) const;
    /// The last stage that takes a step, or the last stage if none does.
    std::uint32_t final_stage() const;
    /// The number of stages that run: all, or those up to `until_stage`.
    std::uint32_t stage_count() const;
};

/// Fails if a stage that runs is one of cells that crawl, which `what` is not made for.
Result<void> check_for_fields(const Script& script, std::string_view what);

/// Parses and checks `text` with its overrides and the files it uses, and the picture block. Errors
/// are reported in the diagnostics only.
Script load_script(std::string name, std::string text, std::filesystem::path folder,
                   Overrides overrides = {});

/// Reads the file first. A PNG that Cascade wrote contains its script: that is loaded, with the
/// stored overrides (those of `overrides` win). Fails if the file cannot be read.
struct LoadedFile {
    Script script;
    std::string picture_options;  ///< JSON of the PictureRequest in a PNG; empty for a script.
    std::vector<std::string> varied = {};  ///< Of a sweep's sheet: its --vary, in order.
    std::string session = {};              ///< Of a picture of a session: its log, not yet parsed.
};
Result<LoadedFile> load_script_file(const std::filesystem::path& path, Overrides overrides = {});

/// A hint for scripts without stages, with their last own system if there is one: "add 'stage
/// spots: mine { }'".
std::string example_of_stage(const Program& program);

/// The default stem of outputs: "leopard" for "examples/leopard.cascade". It comes from the file
/// that the user named, never from a name inside it; "cascade" if there is none.
std::string output_stem(const Script& script);

/// A span for messages about an option: its text becomes the source `<--option>`.
Span option_span(Sources& sources, const std::string& option, const std::string& value);

/// The stage of a name, else of a number from 1. Fails with a list of the names.
Result<std::uint32_t> find_stage(const Program& program, const std::string& asked);

/// The stage that an option names; reports an error at `span` if there is none. Needs a program.
std::optional<std::uint32_t> find_stage_of_option(Script& script, const std::string& name,
                                                  Span span);

}  // namespace cascade
