// A script as it was asked for: its text, what the command line changes about it, and the checked
// program that comes of both.
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
#include <utility>
#include <vector>

namespace cascade {

/// Changes that come from outside the script. They travel inside pictures and saved runs.
struct Overrides {
    std::vector<std::string> sets;  ///< "large.ka=1/400", in order.
    std::optional<GridSize> grid;
    bool grid_is_one_number = false;  ///< As in --grid 100, which is a line. Travels nowhere.
    std::optional<std::uint32_t> seed;
    std::optional<std::int64_t> steps;       ///< A cap for every stage.
    std::optional<std::string> until_stage;  ///< The last stage that runs.
    /// The files that the script uses, as (path, text), as far as they have been read. A picture
    /// can so be drawn again without them.
    std::vector<std::pair<std::string, std::string>> used;
    ReadAccess reads;                   ///< Travels nowhere.
    std::optional<std::string> solver;  ///< Of every stage.
    std::optional<Precision> precision;
    bool fast = false;  ///< Steps are computed with fewer roundings.
    /// The domain becomes this model: the file of one, or the name of a shape.
    std::optional<std::string> model;
    bool model_is_asked_for = false;   ///< By the user: the file may lie anywhere. Travels nowhere.
    std::optional<std::string> cells;  ///< Of the model: a number, faces or vertices.
    std::optional<Axis> up;            ///< Of the model: its axis that points upwards.

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// A loaded script. `program` is null when `diagnostics` has errors.
struct Script {
    Script() = default;
    Script(Script&&) = default;
    Script& operator=(Script&&) = default;
    Script(const Script&) = delete;  // The tree holds views into this script's own sources.
    Script& operator=(const Script&) = delete;

    /// In messages: as the user typed it, "examples/leopard.cascade", or as a picture or a saved
    /// run says.
    std::string name;
    /// What the user named: the script, the picture or the saved run that it was found in.
    std::filesystem::path file;
    std::string text;
    std::filesystem::path folder;  ///< Paths in the script are relative to it.
    Overrides overrides;

    Sources sources;
    Diagnostics diagnostics;
    ast::Script tree;
    std::shared_ptr<const Program> program;

    /// All diagnostics, drawn.
    std::string messages(bool colour) const;
    /// The last stage that will take a step, or the last stage where none will.
    std::uint32_t final_stage() const;
    /// How many stages will run: all, or those up to `until_stage`.
    std::uint32_t stage_count() const;
};

/// Parses and checks `text` with its overrides and the files it uses, picture block included. Never
/// fails otherwise than by diagnostics.
Script load_script(std::string name, std::string text, std::filesystem::path folder,
                   Overrides overrides = {});

/// Reads the file first. A PNG that Cascade wrote carries its script: that is loaded, with the
/// overrides it was made with (`overrides`' own members win). Fails on unreadable files.
struct LoadedFile {
    Script script;
    std::string picture_options;  ///< JSON of the PictureRequest in a PNG; empty for a script.
    std::vector<std::string> varied = {};  ///< Of a sweep's sheet: its --vary, in order.
};
Result<LoadedFile> load_script_file(const std::filesystem::path& path, Overrides overrides = {});

/// What a script without stages lacks, of its own last system if it has one: "add 'stage spots:
/// mine { }'".
std::string example_of_stage(const Program& program);

/// What outputs are called where nothing is said: "leopard" of "examples/leopard.cascade". It comes
/// from what the user named, never from a name inside of that; "cascade" where there is none.
std::string output_stem(const Script& script);

/// A place for messages about an option: the option's own text is the source `<--option>`.
Span option_span(Sources& sources, const std::string& option, const std::string& value);

/// The stage of a name, or else of a number from 1. Fails with the names that there are.
Result<std::uint32_t> find_stage(const Program& program, const std::string& asked);

/// The stage that an option names, or nothing with a message at `span`. Needs a program.
std::optional<std::uint32_t> find_stage_of_option(Script& script, const std::string& name,
                                                  Span span);

}  // namespace cascade
