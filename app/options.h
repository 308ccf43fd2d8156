// The command line as values. Only options.cpp and option_*.cpp include CLI11, whose headers take
// seconds to compile.
#pragma once

#include "lang/format/format_script.h"
#include "ranks/launcher.h"
#include "run/commands/analyze.h"
#include "run/commands/bench.h"
#include "run/commands/follow.h"
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
    follow,
    check,
    analyze,
    bench,
    compile,
    systems,
    examples,
    new_script,
    import_model,
    palettes,
    format,
    mesh,
    repl,
    view,
    lsp,
    export_page
};

/// The picture options that the user has given explicitly. When the run of a saved picture is
/// repeated, they replace the options stored in the picture. Options that the user has not given
/// replace nothing.
struct PictureChanges {
#define CASCADE_PICTURE_OPTION(type, member, ...) std::optional<type> member;
#include "run/script/picture_options.def"
};

PictureRequest apply(const PictureChanges& changes, PictureRequest request);

/// A script that was typed or read from standard input, not from a file.
struct TypedScript {
    std::string name, text;
    std::filesystem::path folder;
    Overrides overrides;
};

struct Options {
    Command command = Command::run;
    std::vector<std::string> arguments;  ///< The words after the program's name.
    /// Contains one script, or several for `check`, `bench` and `fmt`. Empty if only --resume is
    /// given.
    std::vector<std::string> scripts;
    std::optional<TypedScript> typed;  ///< The script that "-" means.
    Overrides overrides;
    PictureChanges picture;
    RunRequest run;      ///< Its member `picture` contains the defaults.
    SweepRequest sweep;  ///< Its members `picture`, `simulation` and `pace` contain the defaults.
    std::filesystem::path sweep_sets;      ///< `sweep --sets`
    std::optional<Variation> sweep_seeds;  ///< `sweep --seeds`
    double limit_seconds = 0;              ///< `--limit-time`. 0: no limit.
    std::string dump;                      ///< The kind of `--dump`. Empty: the script is run.
    /// `run --device`: "gpu", "cpu", a number, or "list". If empty, threads take all steps.
    std::string device;
    int ranks = 0;  ///< `run --ranks`: the number of processes. 0: this process runs alone.
    std::optional<MpiLibrary> mpi;  ///< `--mpi`. Empty: the library of the launcher.
    bool timing = false;            ///< Whether the program prints how the time was spent.
    bool json = false;              ///< Whether all output is printed as one JSON object.
    bool quiet = false;             ///< Whether progress and remarks are omitted.
    /// The words to search for with `systems` and `examples`, or the name of the system for `new`.
    std::vector<std::string> words;
    std::filesystem::path new_script;                      ///< `new -o`, `examples -o`, `import -o`
    bool prints_path = false;                              ///< `examples --path`
    std::vector<std::string> diffusion;                    ///< `import --diffusion`
    std::string preset;                                    ///< `import --preset`
    std::filesystem::path presets;                         ///< `import --presets`
    std::filesystem::path sheet;                           ///< `palettes -o`
    bool check_only = false;                               ///< `fmt --check`
    ScriptNotation notation = ScriptNotation::as_written;  ///< `fmt --unicode`, `--ascii`
    std::vector<std::string> models;                       ///< The arguments of `mesh`.
    std::optional<CellOptions> cells;                      ///< `mesh --cells`.
    std::optional<std::uint32_t> cell_seed;                ///< `mesh --seed`.
    Reshaping reshaping;                                   ///< `mesh --subdivide`, `--simplify`.
    bool lists_points = false;                             ///< `mesh --points`.
    ModelFileOptions mesh_files;                           ///< `mesh --unwrap`.
    std::filesystem::path mesh_output;                     ///< `mesh -o`.
    AnalyzeRequest analyze;
    FollowRequest follow;  ///< `continue`. Its member `simulation` contains the defaults.
    BenchRequest bench;    ///< Its member `simulation` contains the defaults.
    bool csv = false;      ///< `bench --csv`
    CompileRequest compile;
    bool no_browser = false;       ///< `view --no-browser`
    bool prints_words = false;     ///< `lsp --words`
    std::filesystem::path object;  ///< `compile -o`
    std::filesystem::path header;  ///< `compile --header`
    std::filesystem::path html;    ///< `export --html`
    bool exact = false;            ///< `export --exact`
};

inline const TypedScript* typed_of(const Options& options) {
    return options.typed ? &*options.typed : nullptr;
}

/// Tells the program to print `text` and to end. Used for --help and --version, and after wrong
/// options.
struct Leave {
    int status = 0;
    /// Is printed to standard output if `status` is 0, and otherwise to standard error.
    std::string text;
};

/// `program` is the program's name in messages. `arguments` are the words after the name.
std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments);

}  // namespace cascade
