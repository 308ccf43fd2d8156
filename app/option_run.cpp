// Options of pictures and of `cascade run`, from their tables.
#include "app/add_value.h"
#include "app/help.h"
#include "app/option_groups.h"
#include "core/palette.h"

#include <algorithm>
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

/// How the values of both tables are typed: functions of a text, or one of the following.
namespace typed_values {

/// An option without a value, which sets this one.
template <typename T>
struct Constant {
    T value;
};
/// Texts of an option that may be given again.
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

/// One of some words, as the value that it names.
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

/// What the table does not say: options that need or exclude another one.
void relate(CLI::App& app) {
    const auto find = [&](const char* flag) { return app.get_option_no_throw(flag); };
    for (const auto& [flag, needed] :
         {std::pair("--checkpoint", "--save"), {"--log-every", "--log"}, {"--log-file", "--log"}}) {
        if (find(flag)) find(flag)->needs(find(needed));
    }
    for (const auto& [flag, other] :
         {std::pair("--seconds", "--fps"), {"--texels-per-cell", "--bake"}}) {
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
               "The picture, {}; without it SCRIPT.png in this folder; a figure, {}; a film, {}; of a "
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

}  // namespace cascade::option_groups
