// Shows integers with all digits, and other numbers with four digits.
#include "run/commands/frame_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cascade {
namespace {

constexpr const char* name_of_stage = "stage";

std::string written(double number) {
    const bool is_whole = std::trunc(number) == number && std::abs(number) < 1e15;
    return is_whole ? fmt::format("{:.0f}", number) : fmt::format("{:.4g}", number);
}

}  // namespace

Result<FrameLabels> FrameLabels::create(Script& script, std::vector<std::string> words) {
    std::vector<std::string> expressions;
    std::copy_if(words.begin(), words.end(), std::back_inserter(expressions),
                 [](const std::string& word) { return word != name_of_stage; });
    auto numbers = UniformNumbers::create(script, "--label", expressions);
    if (!numbers) return tl::unexpected(numbers.error());
    FrameLabels labels;
    labels.words_ = std::move(words);
    labels.numbers_ = *std::move(numbers);
    return labels;
}

std::string FrameLabels::text(const Simulation& simulation, std::uint32_t stage) const {
    const std::vector<double> numbers = numbers_.at(simulation, stage);
    std::vector<std::string> parts;
    auto number = numbers.begin();
    for (const std::string& word : words_) {
        if (word == name_of_stage) {
            parts.push_back(simulation.domain().stage(stage).name);
        } else if (const double value = *number++; std::isfinite(value)) {
            parts.push_back(fmt::format("{} = {}", word, written(value)));
        }
    }
    return fmt::format("{}", fmt::join(parts, "  "));
}

}  // namespace cascade
