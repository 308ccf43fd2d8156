// The command line: what the user asked for, as values. Only options.cpp and option_*.cpp see
// CLI11, since its headers take seconds to compile.
#pragma once

#include "run/commands/bench.h"
#include "run/commands/run.h"
#include "run/commands/sweep.h"
#include "run/domain/describe_model.h"
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

enum class Command { run, sweep, check, bench, compile, systems, new_script, format, mesh, repl };

/// The options about pictures that were given. A picture that is run again brings options of its
/// own, so what was not given must be told from what is the default.
struct PictureChanges {
    std::optional<std::string> show;
    std::optional<std::string> palette;
    std::optional<ValueRange> range;
    std::optional<int> scale;
    std::optional<int> depth;
    bool space_time = false;
    std::optional<Slice> slice;
    bool flat = false;
    std::optional<View> view;
    std::optional<float> bump;
};

PictureRequest apply(const PictureChanges& changes, PictureRequest request);

struct Options {
    Command command = Command::run;
    std::vector<std::string>
        scripts;  ///< One, but for `check`, `bench`, `fmt`; none with --resume alone.
    Overrides overrides;
    PictureChanges picture;
    RunRequest run;                          ///< Its `picture` is left at the defaults.
    SweepRequest sweep;                      ///< Its `picture` and `simulation` too.
    double limit_seconds = 0;                ///< `--limit-time`; 0: none.
    std::string dump;                        ///< A dump kind; empty to run.
    bool timing = false;                     ///< Say where the time went.
    bool quiet = false;                      ///< Neither progress nor remarks.
    std::vector<std::string> words;          ///< What `systems` looks for; the system of `new`.
    std::filesystem::path new_script;        ///< `new -o`
    bool check_only = false;                 ///< `fmt --check`
    std::vector<std::string> models;         ///< Of `mesh`.
    std::optional<CellOptions> cells;        ///< `mesh --cells`.
    std::optional<std::uint32_t> cell_seed;  ///< `mesh --seed`.
    BenchRequest bench;                      ///< Its `simulation` is left at the defaults.
    bool csv = false;                        ///< `bench --csv`
    CompileRequest compile;
    std::filesystem::path object;  ///< `compile -o`
    std::filesystem::path header;  ///< `compile --header`
};

/// Nothing to do but to print and to leave: --help, --version, wrong use.
struct Leave {
    int status = 0;
    std::string text;  ///< For standard output if `status` is 0, else for standard error.
};

/// `program` is what messages call us; `arguments` come without it.
std::variant<Options, Leave> parse_options(const std::string& program,
                                           const std::vector<std::string>& arguments);

}  // namespace cascade
