// Options of `cascade analyze`.
#include "app/add_value.h"
#include "app/option_groups.h"
#include "core/file_format.h"

namespace cascade::option_groups {

void add_analyze(CLI::App& app, Options& options) {
    AnalyzeRequest& analyze = options.analyze;
    const std::string what = "What is analyzed";
    add_value(app, "--stage", "STAGE", "Name or number of the stage; by default the first",
              any_text, [&](auto stage) { analyze.stage = stage; })
        ->group(what);
    const auto read_all = [&](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            analyze.varied.push_back(value_or_throw(parse_varied_range(text), "--vary"));
        }
        if (analyze.varied.size() > 2) {
            throw CLI::ValidationError("--vary", "at most two parameters can be varied");
        }
    };
    app.add_option_function<std::vector<std::string>>(
           "--vary", read_all,
           "Find the critical values of a parameter in a range, as in\nfeed=0.02..0.06; given "
           "twice, draw a map over both. By\ndefault every parameter with a range in the script")
        ->allow_extra_args(false)
        ->type_name("NAME=RANGE")
        ->group(what);
    const std::string group = "Output";
    app.add_flag("--json", analyze.as_json, "The result as JSON instead of words")->group(group);
    const auto parse_output = [](const std::string& text) -> Result<std::string> {
        if (is_analysis_output(text)) return text;
        return failure(fmt::format("'{}' does not end in {} or {}", text,
                                   endings_of(FormatTrait::drawing),
                                   endings_of(FormatKind::report)));
    };
    add_value(app, "-o,--output", "FILE",
              fmt::format("FILE{}, the dispersion relation or the\nmap as a plot; FILE{}",
                          endings_of(FormatTrait::drawing, "or"), endings_of(FormatKind::report)),
              parse_output, [&](auto path) { analyze.output = path; })
        ->group(group);
}

}  // namespace cascade::option_groups
