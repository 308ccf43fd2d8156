// Options of `cascade sweep`.
#include "app/add_value.h"
#include "app/help.h"
#include "app/option_groups.h"
#include "core/file_format.h"

namespace cascade::option_groups {

namespace {

void add_varied(CLI::App& app, Options& options) {
    SweepRequest& sweep = options.sweep;
    const std::string varied = "What is varied";
    const auto read_all = [&](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            sweep.varied.push_back(value_or_throw(parse_variation(text), "--vary"));
        }
    };
    app.add_option_function<std::vector<std::string>>(
           "--vary", read_all,
           "A parameter or setting and its values: a range with a number\nof values, "
           "feed=0.02..0.06:9, or a list, ka=1/400,1/200;\nwith :log in equal ratios, "
           "0.001..1:7:log; may be given\nagain: the first runs across, the second up")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUES")
        ->group(varied);
    add_value(
        app, "--sets", "FILE.csv",
        "A table of parameter sets: names in its first line, and a\nrow of numbers for each run",
        any_text, [&](auto path) { options.sweep_sets = path; })
        ->group(varied);
    add_seeds(app, options, varied,
              "Repeat every run with these seeds, or with a list 3,7,12;\nensembles.csv has means "
              "with their 95 % intervals");
}

void add_sweep_files(CLI::App& app, Options& options) {
    SweepRequest& sweep = options.sweep;
    const std::string files = "Files";
    add_value(app, "-o,--output", "FOLDER",
              "Folder of the results; by default SCRIPT_sweep in this folder", parse_folder,
              [&](auto path) { sweep.folder = path; })
        ->group(files);
    add_value(app, "--tile", "N",
              "Pixels of a picture's longer side, 16 to 1024; larger ones are\n"
              "averaged down (160)",
              whole_number(16, 1024), [&](auto side) { sweep.tile_side = static_cast<int>(side); })
        ->group(files);
    add_value(app, "--film", "FILE",
              help::in_lines(
                  fmt::format("A film of the ends of all runs, {}; --tile sets the size of its "
                              "pictures",
                              endings_of(FormatKind::film, "or"))),
              path_of(FormatKind::film), [&](auto path) { sweep.film = path; })
        ->group(files);
    add_run_options(app, options.run, RunOption::fps, RunOption::seconds);
    app.add_option(
           "--curve", sweep.curves,
           "Plot a feature against the first varied name, as FEATURE.svg;\nmay be given several "
           "times")
        ->allow_extra_args(false)
        ->type_name("FEATURE")
        ->group(files);
    app.add_flag("--fields", sweep.fields, "Save every field of every run, to read or to resume")
        ->group(files);
    add_value(
        app, "--data", "FILE.h5",
        "The fields at the end of all runs, with their values and\nfeatures, as one HDF5 file; "
        "also saves fields as --fields does",
        parse_data_path, [&](auto path) { sweep.data = path; })
        ->group(files);
    app.add_flag("--force", sweep.force, "Repeat runs of an earlier sweep")->group(files);
}

void add_sweep_processes(CLI::App& app, SweepRequest& sweep) {
    const std::string divided = "Many processes";
    add_value(app, "--part", "K/N",
              "Take the K-th of N parts of the runs; the same command\nwithout --part draws the "
              "sheet when all parts are done",
              parse_part, [&](auto part) { sweep.part = part; })
        ->group(divided);
    app.add_option_function<std::vector<std::string>>(
           "--gather",
           [&](const std::vector<std::string>& folders) {
               sweep.gathered.assign(folders.begin(), folders.end());
           },
           "Copy the results in this folder of another sweep;\nmay be given again")
        ->allow_extra_args(false)
        ->type_name("FOLDER")
        ->group(divided);
}

}  // namespace

void add_seeds(CLI::App& app, Options& options, const std::string& group, const std::string& help) {
    add_value(app, "--seeds", "FIRST..LAST", help, parse_seeds, [&](auto seeds) {
        options.sweep_seeds = std::move(seeds);
    })->group(group);
}

void add_sweep(CLI::App& app, Options& options) {
    add_varied(app, options);
    add_sweep_files(app, options);
    add_sweep_processes(app, options.sweep);
}

}  // namespace cascade::option_groups
