// The options of pictures, of runs and of scripts. They are made from the tables in run/script and
// run/commands.
#include "app/add_value.h"
#include "app/help.h"
#include "app/option_groups.h"
#include "core/axis.h"
#include "core/palette.h"
#include "lang/program/program.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <vector>

namespace cascade::option_groups {

namespace {

constexpr const char* files = "Files";
constexpr const char* numbers = "Numbers";
constexpr const char* execution = execution_group;

std::vector<std::string> palette_names() {
    std::vector<std::string> names;
    for (const Palette& palette : palettes()) names.emplace_back(palette.name);
    return names;
}

/// The parsers for the values of options in all three tables. Each is a function of a text, or one
/// of the following objects.
namespace typed_values {

/// Sets a constant. The option has no argument.
template <typename T>
struct Constant {
    T value;
};
/// Adds the option's text to a list. The option may be given several times.
struct Texts {};

template <typename T>
auto constant(T value) {
    return Constant<T>{value};
}
auto flag() { return constant(true); }
auto texts() { return Texts(); }
auto text() { return any_text; }
auto path(FormatKind kind) { return path_of(kind); }
auto folder() { return parse_folder; }
auto frames_folder() { return parse_frames_folder; }
auto whole(std::int64_t low, std::int64_t high) { return whole_number(low, high); }
auto steps() { return whole(1, std::numeric_limits<std::int64_t>::max()); }
auto duration() { return parse_duration; }
auto times() { return parse_times; }
auto time() { return parse_time; }
auto frame_rate() { return parse_frame_rate; }
auto film_length() { return parse_film_length; }
auto texels() { return parse_texels; }
auto stop_at() { return parse_stop_at; }
auto range() { return parse_range; }
auto slice() { return parse_slice; }
auto view() { return parse_view; }
auto size() { return parse_picture_size; }
auto copies() { return parse_copies; }
auto degrees(float, float) { return parse_fov; }
auto part_of_model(float, float) { return parse_bump; }
auto background() { return background_named; }

/// Parses one of several words, and converts it to the value with that name.
template <typename Named>
auto named(std::vector<std::string> words, Named value_of) {
    return [known = one_of(std::move(words)), value_of](const std::string& text) {
        return known(text).map([&](const std::string& word) { return value_of(word); });
    };
}
template <typename Names, typename Named>
auto word_of(const Names& names, Named value_of) {
    return named({names.begin(), names.end()},
                 [=](const std::string& word) { return *value_of(word); });
}
auto quality() { return word_of(quality_names, quality_named); }
auto lighting() { return word_of(lighting_names, lighting_named); }
auto axis() { return word_of(axis_names, axis_of_name); }
auto heading() { return word_of(heading_names, heading_of_name); }
auto precision() {
    return word_of(std::array{name_of(Precision::single), name_of(Precision::binary64)},
                   precision_of_name);
}
/// As in scripts, `imex2` is accepted (see solver_of()), but it is not listed.
auto solver() {
    std::vector<std::string> names = solver_names();
    names.emplace_back("imex2");
    return one_of(std::move(names));
}
auto yes_or_no() {
    return named({"yes", "no"}, [](const std::string& word) { return word == "yes"; });
}
auto either(int one, int other) {
    return named({std::to_string(one), std::to_string(other)},
                 [](const std::string& word) { return std::stoi(word); });
}
auto palette() {
    return [known = one_of(palette_names())](const std::string& text) -> Result<std::string> {
        if (const Palette* const found = find_palette(text)) return std::string(found->name);
        return known(text);
    };
}

}  // namespace typed_values

template <typename Member, typename T>
void set(Member& member, T value) {
    if constexpr (std::is_arithmetic_v<T> && std::is_arithmetic_v<Member>) {
        member = static_cast<Member>(value);
    } else if constexpr (std::is_arithmetic_v<T> && requires { typename Member::value_type; }) {
        member = static_cast<typename Member::value_type>(value);
    } else {
        member = std::move(value);
    }
}

template <typename Member, typename Values>
CLI::Option* add_row(CLI::App& app, const std::string& flag, const std::string& value,
                     const std::string& help, Values values, Member& member) {
    return add_value(app, flag, value, help, std::move(values),
                     [&member](auto read) { set(member, std::move(read)); });
}

template <typename Member, typename T>
CLI::Option* add_row(CLI::App& app, const std::string& flag, const std::string&,
                     const std::string& help, typed_values::Constant<T> constant, Member& member) {
    return app.add_flag_callback(
        flag, [&member, constant] { member = constant.value; }, help);
}

CLI::Option* add_row(CLI::App& app, const std::string& flag, const std::string& value,
                     const std::string& help, typed_values::Texts,
                     std::vector<std::string>& member) {
    return app.add_option(flag, member, help)->allow_extra_args(false)->type_name(value);
}

/// Returns the name of the option that sets the member `name`.
std::string flag_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return "--" + name;
}

/// Declares which options need or exclude other options, because the tables do not contain this.
void relate(CLI::App& app) {
    const auto find = [&](const char* flag) { return app.get_option_no_throw(flag); };
    for (const auto& [flag, needed] :
         {std::pair("--checkpoint", "--save"), {"--log-every", "--log"}, {"--log-file", "--log"}}) {
        if (find(flag)) find(flag)->needs(find(needed));
    }
    for (const auto& [flag, other] : {std::pair("--seconds", "--fps"),
                                      {"--texels-per-cell", "--bake"},
                                      {"--at", "--every"},
                                      {"--at", "--log-every"},
                                      {"--every", "--log-every"}}) {
        if (find(flag)) find(flag)->excludes(find(other));
    }
}

}  // namespace

void add_picture_options(CLI::App& app, PictureChanges& picture, bool is_sweep) {
#define CASCADE_PICTURE_OPTION(type, member, initial, key, stored, values, value, sweeps, help) \
    if (sweeps || !is_sweep) {                                                                  \
        add_row(app, flag_of(RunOption::member), value, help, typed_values::values,             \
                picture.member)                                                                 \
            ->group("What the picture shows");                                                  \
    }
#include "run/script/picture_options.def"
}

void add_run_options(CLI::App& app, RunRequest& run, RunOption first, RunOption last) {
#define CASCADE_RUN_OPTION(id, member, flag, values, value, group_name, help)                 \
    if (RunOption::id >= first && RunOption::id <= last) {                                    \
        add_row(app, flag, value, help, typed_values::values, run.member)->group(group_name); \
    }
#include "run/commands/run_options.def"
    relate(app);
}

void add_files(CLI::App& app, RunRequest& run) {
    app.add_option_function<std::vector<std::string>>(
           "-o,--output",
           [&](const std::vector<std::string>& paths) {
               for (const std::string& path : paths) {
                   run.outputs.emplace_back(value_or_throw(parse_output_path(path), "--output"));
               }
           },
           help::in_lines(fmt::format(
               "The picture, {}; by default SCRIPT.png in this folder; a figure, {}; a film, {}; "
               "of a "
               "model also {}, and its cells, {}; may be given again",
               endings_of(FormatKind::picture), endings_of(FormatKind::figure),
               endings_of(FormatKind::film), endings_of(FormatKind::model),
               endings_of(FormatKind::cells))))
        ->allow_extra_args(false)
        ->trigger_on_parse()
        ->type_name("FILE")
        ->group(files);
    add_run_options(app, run, RunOption::sheet, RunOption::resume);
}

void add_allow_read(CLI::App& app, ReadAccess& reads, const std::string& about) {
    app.add_option_function<std::vector<std::string>>(
           "--allow-read",
           [&](const std::vector<std::string>& folders) {
               for (const std::string& folder : folders) {
                   if (folder == "all") reads.everything = true;
                   else reads.folders.emplace_back(folder);
               }
           },
           about)
        ->allow_extra_args(false)
        ->trigger_on_parse()
        ->type_name("FOLDER|all")
        ->group("Limits");
}

void add_overrides(CLI::App& app, Overrides& overrides) {
    const std::string group = "Changes to the script, without editing it";
    const auto add_rows = [&](bool with_domain) {
#define CASCADE_OVERRIDE(type, member, of_domain, is_statement, values, value, help)        \
    if (of_domain == with_domain) {                                                         \
        add_row(app, flag_of(#member), value, help, typed_values::values, overrides.member) \
            ->group(group);                                                                 \
    }
#include "run/script/override_options.def"
    };
    add_value(
        app, "--grid", "WxH", "Columns and rows; '60' is a line of cells, '64x64x32'\nhas slices",
        [&](const std::string& text) {
            overrides.grid_is_one_number = text.find('x') == std::string::npos;
            return parse_grid(text);
        },
        [&](auto grid) { overrides.grid = grid; })
        ->group(group);
    add_value(app, "--mesh", "MODEL",
              "Grow on this model: a file (PLY, OBJ, OFF, STL,\nglTF, GLB), sphere, torus, box, "
              "knot, creature,\nleopard, giraffe, zebra, fish or frog",
              any_text,
              [&](const std::string& model) {
                  overrides.model = model;
                  overrides.model_is_asked_for = true;
              })
        ->group(group);
    add_rows(true);
    app.add_flag(
           "--fast", overrides.fast,
           "Round less often: compute a * b + c in one operation; the\nbits of results differ "
           "from runs without it")
        ->group(group);
    app.add_option("--set", overrides.sets,
                   "A parameter or setting: ka=1/400, large.ka=1/400;\nmay be given again")
        ->allow_extra_args(false)
        ->type_name("NAME=EXPR")
        ->group(group);
    add_value(app, "--interval", "N",
              "Observe each stage every N steps: for --log, --frames,\nfilms and --series",
              typed_values::whole(1, 1'000'000'000),
              [&](std::int64_t steps) {
                  overrides.sets.push_back(fmt::format("interval={}", steps));
              })
        ->group(group);
    add_rows(false);
    add_allow_read(
        app, overrides.reads,
        "The script may read files below this folder too, not\nonly below its own; 'all': "
        "everywhere; may be given\nagain");
}

}  // namespace cascade::option_groups
