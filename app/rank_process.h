// Commands on several ranks. Ranks are processes that mpiexec starts, and that share the work.
#pragma once

#include "app/console.h"
#include "app/options.h"

namespace cascade {

class Ranks;

/// A command that runs on ranks, or in this process alone if `ranks` is null.
using CommandOnRanks = int(const Options& options, Console& console, Ranks* ranks);

/// Fails if the script comes from standard input, which ranks cannot share.
Result<void> check_readable_by_ranks(const Options& options);

/// Runs a command as one of the ranks that a launcher has started. Only rank 0 writes files and
/// messages. If a rank fails, all ranks end. Rank 0 reports its failure at once. Any other rank
/// first waits a moment for the report of rank 0, and then reports its own failure.
int run_as_rank(const Options& options, Console& console, CommandOnRanks& command);

/// Makes this process take its share of the steps. On all ranks but rank 0, the request then writes
/// no files. Fails if the ranks cannot share the steps of this script. All arguments must outlive
/// the run.
Result<void> share_steps(const Script& script, Ranks& ranks, RunRequest& request,
                         RunControl& control);

/// Makes this process take its share of the runs of a sweep. Fails if this rank has another script
/// than rank 0. `ranks` must outlive the sweep.
Result<void> share_runs(const Script& script, Ranks& ranks, SweepRequest& request);

/// Starts the ranks of `--ranks N` by mpiexec, which runs this program again with the same
/// arguments, and waits for them. Passes Ctrl-C on to rank 0. Prints one message if a rank fails or
/// is killed.
int start_ranks(const Options& options, Console& console);

}  // namespace cascade
