// Options of `cascade continue`.
#include "app/add_value.h"
#include "app/option_groups.h"
#include "core/file_format.h"

namespace cascade::option_groups {

namespace {

/// Reads a number that lies between `low` and `high` and equals neither.
auto number_between(double low, double high) {
    return [=](const std::string& text) -> Result<double> {
        const auto number = read_number(text);
        if (number && *number > low && *number < high) return *number;
        return failure(fmt::format("'{}' is not a number between {} and {}", text, low, high));
    };
}

}  // namespace

void add_follow(CLI::App& app, Options& options) {
    FollowRequest& follow = options.follow;
    const std::string what = "What is followed";
    add_value(app, "--vary", "NAME=RANGE", "The parameter and its range, as in feed=0.02..0.06",
              parse_varied_range, [&](auto range) { follow.varied = range; })
        ->group(what);
    add_value(app, "--stage", "STAGE", "Name or number of the stage; by default the last", any_text,
              [&](auto stage) { follow.stage = stage; })
        ->group(what);
    app.add_flag(
           "--flat", follow.from_flat,
           "Begin with the flat state, in which all cells are equal,\nand not with the end of "
           "the run")
        ->group(what);
    add_value(
        app, "--branches", "N",
        "Follow up to N branches: also branches that meet the\nfirst ones, in the order of their "
        "points (1)",
        whole_number(1, 1000),
        [&](auto count) { follow.branches = static_cast<std::size_t>(count); })
        ->group(what);
    add_value(app, "--points", "N", "The most points of a branch on each side of its first (400)",
              whole_number(1, 1000000),
              [&](auto count) { follow.points = static_cast<std::size_t>(count); })
        ->group(what);
    add_value(app, "--step", "SIZE",
              "The longest step, in parts of the range and of the usual\nvalues of species (0.05)",
              number_between(0, 10), [&](double step) { follow.step = step; })
        ->group(what);
    const std::string files = "Files";
    const auto read_all = [&](const std::vector<std::string>& paths) {
        for (const std::string& path : paths) {
            if (!is_branches_output(path)) {
                throw CLI::ValidationError("-o",
                                           fmt::format("'{}' does not end in .csv, {}", path,
                                                       endings_of(FormatTrait::drawing, "or")));
            }
            follow.outputs.emplace_back(path);
        }
    };
    app.add_option_function<std::vector<std::string>>(
           "-o,--output", read_all,
           "FILE.csv, a table of all points, or a diagram, FILE.svg,\n.png or .pdf; may be given "
           "again; by default\nSCRIPT_branches.csv and SCRIPT_branches.svg")
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group(files);
    add_value(
        app, "--curve", "NUMBER",
        "The vertical axis of the diagram: norm, min, max or mean\nof the first species, or of "
        "another, as in max_v",
        any_text, [&](auto number) { follow.up = number; })
        ->group(files);
    add_value(app, "--pictures", "N",
              "The most small pictures of states below the diagram,\n0 to 12 (6)",
              whole_number(0, 12),
              [&](auto count) { follow.pictures = static_cast<std::size_t>(count); })
        ->group(files);
    add_value(app, "--save", "DIR", "Save every state as a run, to go on from it by run --resume",
              parse_folder, [&](auto path) { follow.save = path; })
        ->group(files);
}

}  // namespace cascade::option_groups
