// A system of the library in a stage of a test's own, run step by step through the public library.
#pragma once

#include "include/cascade/cascade.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::models {

class Model {
public:
    /// A whole script. Faults fail the test that made it.
    explicit Model(const std::string& script);
    /// One stage of a library's system: `domain` and `stage` are the sentences of these blocks.
    Model(const std::string& system, const std::string& domain, const std::string& stage);

    /// Takes steps; a run that fails or ends too early fails the test.
    void step(std::int64_t count);
    /// Takes all steps of all stages.
    void finish();

    bool ok() const { return pattern_.ok() && pattern_.error().empty(); }
    std::int64_t width() const { return pattern_.width(); }
    /// Row by row.
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

/// The place, in cells from the left, where a row of values falls below a level for the last time;
/// linear between the cells' centres.
double front_position(const std::vector<double>& row, double level);

/// The amplitude of the wave cos(2 π mode x + phase) in a periodic row.
double wave_amplitude(const std::vector<double>& row, int mode);

}  // namespace cascade::models
