// Runs a system of the library in a stage that the test writes, step by step, through Cascade's
// public interface.
#pragma once

#include "include/cascade/cascade.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::models {

class Model {
public:
    /// Loads a whole script. Errors make the test fail.
    explicit Model(const std::string& script);
    /// Loads one stage with a system of the library. `domain` and `stage` are the statements of
    /// these blocks.
    Model(const std::string& system, const std::string& domain, const std::string& stage);

    /// Takes steps. If the run fails or ends too early, the test fails.
    void step(std::int64_t count);
    /// Takes all steps of all stages.
    void finish();

    bool ok() const { return pattern_.ok() && pattern_.error().empty(); }
    std::int64_t width() const { return pattern_.width(); }
    /// The values of an expression in all cells, row by row.
    std::vector<double> values(const std::string& expression) const;
    double at(const std::string& expression, std::size_t cell) const;
    double mean(const std::string& expression) const;
    /// Standard deviation over the cells.
    double deviation(const std::string& expression) const;
    double smallest(const std::string& expression) const;
    double largest(const std::string& expression) const;

private:
    mutable Pattern pattern_;
};

/// The position, in cells from the left, at which a row of values falls below a level for the last
/// time, interpolated linearly between the centres of cells.
double front_position(const std::vector<double>& row, double level);

/// The amplitude of the wave cos(2 π mode x + phase) in a periodic row.
double wave_amplitude(const std::vector<double>& row, int mode);

}  // namespace cascade::models
