// Options of `cascade bench`.
#include "app/add_value.h"
#include "app/option_groups.h"

namespace cascade::option_groups {

void add_bench(CLI::App& app, Options& options) {
    const std::string group = "What is measured";
    add_value(app, "--stage", "STAGE",
              "Name or number of one stage to measure; by default all stages", any_text,
              [&](auto stage) { options.bench.stage = stage; })
        ->group(group);
    add_value(app, "--seconds", "S", "How long to measure each stage, in seconds (1)",
              parse_measuring_time, [&](double seconds) { options.bench.seconds = seconds; })
        ->group(group);
    app.add_flag("--csv", options.csv,
                 "A line of comma-separated values for each stage, without\nthe machine's limits")
        ->group(group);
}

}  // namespace cascade::option_groups
