// The HDF5 file of a sweep: the fields at the end of every run, with its values and features.
#pragma once

#include "picture/hdf5.h"
#include "picture/npy.h"
#include "run/commands/sweep.h"
#include "run/commands/sweep_plan.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Checks before the first run whether the file can be written. All runs need grids of the same
/// size, and the names of fields, varied values and features must differ. `script` is the script of
/// a run.
Result<void> check_sweep_data(const Script& script, const SweepRequest& request);

/// Whether the fields of two runs have the same shape.
bool have_same_shape(const Program& one, const Program& other);

/// Reads fields from the folders of saved runs. Runs are added in their order, so that the same
/// sweep writes the same file. A run waits in its folder until all runs before it are done. Runs
/// that failed are left out.
class SweepData {
public:
    /// `request` and `plan` must outlive the object. `folder` is the folder of the sweep.
    SweepData(const Script& script, const SweepRequest& request, const SweepPlan& plan,
              std::filesystem::path folder);
    ~SweepData();

    /// Adds the runs whose predecessors are all done. The first run makes the file. A killed
    /// process leaves a file that can be read.
    Result<void> add_done(std::span<const std::optional<SweepResult>> results);
    /// Adds all other results, and completes the file. Returns false if no run has a result.
    Result<bool> finish(std::span<const std::optional<SweepResult>> results);

private:
    struct File;
    Result<void> begin(const NpyArray& shape);
    Result<void> add(std::size_t number, const SweepResult& result);

    const Script script_;  ///< Of the first run.
    const SweepRequest& request_;
    const SweepPlan& plan_;
    const std::filesystem::path folder_;
    const std::vector<Hdf5Record> records_;
    std::size_t next_ = 0;  ///< The number of runs that are added or left out.
    std::unique_ptr<File> file_;
};

}  // namespace cascade
