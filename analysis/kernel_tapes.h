// The kernel of a convolution as numbers, at given values of parameters.
#pragma once

#include "analysis/linear_model.h"
#include "analysis/tape.h"

#include <memory>
#include <optional>
#include <span>

namespace cascade::analysis {

class KernelTapes {
public:
    KernelTapes(const LinearModel& model, const KernelFormula& kernel);

    /// Whether the kernel depends on items of the model that are varied.
    bool varies() const { return varies_; }

    /// The kernel at these values of the varied items. Null if it has more than most_lags lags.
    std::shared_ptr<const WaveKernel> at(std::span<const double> varied) const;
    bool has_too_many_lags(std::span<const double> varied) const;

    /// With at most so many lags, the analysis of a stage takes a few tenths of a second.
    static constexpr std::int64_t most_lags = std::int64_t{1} << 16;

private:
    std::optional<double> reach(std::span<const double> varied) const;

    const LinearModel& model_;
    Tape weight_;
    std::optional<Tape> reach_;
    bool varies_ = false;
};

}  // namespace cascade::analysis
