// The command line as values. Only options.cpp and option_*.cpp see CLI11, since its headers take
// seconds to compile.
#pragma once

#include "lang/format/format_script.h"
#include "run/commands/analyze.h"
#include "run/commands/bench.h"
#include "run/commands/run.h"
#include "run/commands/sweep.h"
#include "run/domain/describe_model.h"
#include "run/domain/reshape_model.h"
#include "run/emit_c/compile.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cascade {

enum class Command {
    run,
    sweep,
    check,
    analyze,
    bench,
    compile,
    systems,
    new_script,
    palettes,
    format,
    mesh,
    repl,
    view,
    export_page
};

/// The picture options that were given. A picture that is run again has stored options of its own,
/// so an option that was given must be told from a default.
struct PictureChanges {
#define CASCADE_PICTURE_OPTION(type, member, ...) std::optional<type> member;
#include "run/script/picture_options.def"
};

PictureRequest apply(const PictureChanges& changes, PictureRequest request);

/// A script that is in no file.
struct TypedScript {
    std::string name, text;
    std::filesystem::path folder;
    Overrides overrides;
};

struct Options {
    Command command = Command::run;
    std::vector<std::string>
        scripts;  ///< One, except for `check`, `bench` and `fmt`; none with --resume alone.
    std::optional<TypedScript> typed;  ///< Stands for the script "-".
    Overrides overrides;
    PictureChanges picture;
    RunRequest run;      ///< Its `picture` keeps the defaults.
    SweepRequest sweep;  ///< Its `picture`, `simulation` and `pace` keep the defaults.
    std::filesystem::path sweep_sets;  ///< `sweep --sets`
    double limit_seconds = 0;          ///< `--limit-time`; 0 for none.
    std::string dump;                  ///< The kind of dump; empty to run.
    bool timing = false;               ///< Print how the time was spent.
    bool json = false;                 ///< All output as one object.
    bool quiet = false;                ///< Neither progress nor remarks.
    std::vector<std::string> words;    ///< What `systems` searches for; the system of `new`.
    std::filesystem::path new_script;  ///< `new -o`
    std::filesystem::path sheet;       ///< `palettes -o`
    bool check_only = false;           ///< `fmt --check`
    ScriptNotation notation = ScriptNotation::as_written;  ///< `fmt --unicode`, `--ascii`
    std::vector<std::string> models;                       ///< Arguments of `mesh`.
    std::optional<CellOptions> cells;                      ///< `mesh --cells`.
    std::optional<std::uint32_t> cell_seed;                ///< `mesh --seed`.
    Reshaping reshaping;                                   ///< `mesh --subdivide`, `--simplify`.
    bool lists_points = false;                             ///< `mesh --points`.
    ModelFileOptions mesh_files;                           ///< `mesh --unwrap`.
    std::filesystem::path mesh_output;                     ///< `mesh -o`.
    AnalyzeRequest analyze;
    BenchRequest bench;  ///< Its `simulation` keeps the defaults.
    bool csv = false;    ///< `bench --csv`
    CompileRequest compile;
    bool no_browser = false;       ///< `view --no-browser`
    std::filesystem::path object;  ///< `compile -o`
    std::filesystem::path header;  ///< `compile --header`
    std::filesystem::path html;    ///< `export --html`
    bool exact = false;            ///< `export --exact`
};

inline const TypedScript* typed_of(const Options& options) {
    return options.typed ? &*options.typed : nullptr;
}

/// Print `text` and leave: --help, --version, wrong use.
struct Leave {
    int status = 0;
    std::string text;  ///< For standard output if `status` is 0, else for standard error.
};

/// `program` is the program's name in messages; `arguments` are those after it.
std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments);

}  // namespace cascade
