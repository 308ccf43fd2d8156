#include "tests/models/model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace cascade::models {

namespace {

PatternOptions options() {
    PatternOptions result;
    result.native_code = CASCADE_HAS_JIT != 0;
    result.threads = 1;
    return result;
}

}  // namespace

Model::Model(const std::string& script) : pattern_(script, options()) {
    EXPECT_TRUE(pattern_.ok()) << pattern_.messages() << script;
}

Model::Model(const std::string& system, const std::string& domain, const std::string& stage)
    : Model(fmt::format("domain {{\n{}\n}}\nstage test: {} {{\n  iterations: 100000000\n{}\n}}\n",
                        domain, system, stage)) {}

void Model::step(std::int64_t count) {
    if (!ok()) return;
    EXPECT_EQ(pattern_.step(count), count) << pattern_.error();
}

void Model::finish() {
    while (ok() && !pattern_.finished()) pattern_.step(1000000);
    EXPECT_EQ(pattern_.error(), "");
}

std::vector<double> Model::values(const std::string& expression) const {
    if (!ok()) return {0.0};
    const std::vector<float> numbers = pattern_.values(expression);
    EXPECT_FALSE(numbers.empty()) << pattern_.messages();
    return {numbers.begin(), numbers.end()};
}

double Model::at(const std::string& expression, std::size_t cell) const {
    const std::vector<double> numbers = values(expression);
    return cell < numbers.size() ? numbers[cell] : std::numeric_limits<double>::quiet_NaN();
}

double Model::mean(const std::string& expression) const {
    const std::vector<double> numbers = values(expression);
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) /
           static_cast<double>(numbers.size());
}

double Model::deviation(const std::string& expression) const {
    const std::vector<double> numbers = values(expression);
    const double middle = mean(expression);
    double sum = 0;
    for (const double number : numbers) sum += (number - middle) * (number - middle);
    return std::sqrt(sum / static_cast<double>(numbers.size()));
}

double Model::smallest(const std::string& expression) const {
    const std::vector<double> numbers = values(expression);
    return *std::min_element(numbers.begin(), numbers.end());
}

double Model::largest(const std::string& expression) const {
    const std::vector<double> numbers = values(expression);
    return *std::max_element(numbers.begin(), numbers.end());
}

double front_position(const std::vector<double>& row, double level) {
    for (std::size_t i = row.size(); i-- > 1;) {
        if (row[i - 1] < level || row[i] >= level) continue;
        return static_cast<double>(i) - 0.5 + (row[i - 1] - level) / (row[i - 1] - row[i]);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double wave_amplitude(const std::vector<double>& row, int mode) {
    double cosine = 0, sine = 0;
    const auto count = static_cast<double>(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
        const double phase = 2 * std::numbers::pi * mode * (static_cast<double>(i) + 0.5) / count;
        cosine += row[i] * std::cos(phase);
        sine += row[i] * std::sin(phase);
    }
    return 2 * std::hypot(cosine, sine) / count;
}

}  // namespace cascade::models
