// Runs scripts for the tests of this folder and returns their fields.
#pragma once

#include "run/simulation/simulation.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

/// A script and its simulation. Errors of the script or the simulation, warnings of the run, and
/// remarks on its stages make the test fail.
class TestRun {
public:
    TestRun(std::string name, std::string text, Overrides overrides, SimulationOptions options);
    TestRun(const TestRun&) = delete;  // The simulation points to the script.

    /// False after an error, which has already made the test fail.
    bool ok() const { return simulation_ != nullptr && !failed_; }
    /// Computes the starting values of a stage. Stages are started in their order.
    void start(std::uint32_t stage);
    /// Takes all steps of a started stage.
    void finish(std::uint32_t stage);
    /// Starts and finishes every stage.
    void finish_all();

    const Program& program() const { return *simulation_->domain().program; }
    std::size_t width() const { return static_cast<std::size_t>(simulation_->domain().grid.width); }
    std::size_t height() const {
        return static_cast<std::size_t>(simulation_->domain().grid.height);
    }
    /// The present values of a species, parameter, `frozen` or `speed` of a stage, row by row.
    std::vector<double> values(std::uint32_t stage, const std::string& name) const;

private:
    void check(const Result<void>& result);

    bool is_cut_short_;     ///< Whether the run takes fewer steps than its script says.
    bool is_other_solver_;  ///< Whether the run has another solver than its script says.
    Script script_;
    std::unique_ptr<Simulation> simulation_;
    bool failed_ = false;
};

/// The text of a file of the source tree. The test fails if the file cannot be read.
std::string source_file(const std::string& path);

/// Native code if Cascade was built with it, otherwise the interpreter, on one thread.
SimulationOptions on_fastest_backend();

}  // namespace cascade
