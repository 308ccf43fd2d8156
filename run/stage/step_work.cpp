// Counts the operations of each kernel (ir/kernel_cost.h). In each pass, counts each plane once.
#include "run/stage/step_work.h"

#include "core/check.h"

#include <algorithm>
#include <set>

namespace cascade {

namespace {

/// Returns the mean number of links of a cell, including unused links that fill up slices.
double links_of(const StepProblem& problem) {
    if (problem.links == nullptr) return 0;
    constexpr std::int64_t slice = PlaneLayout::row_pad;
    const std::int64_t slices = (problem.grid.width + slice - 1) / slice * problem.grid.height;
    const std::uint32_t* const starts = with_number(problem.precision, [&](auto zero) {
        return problem.links->table<decltype(zero)>().starts;
    });
    return static_cast<double>(slice * starts[slices]) /
           static_cast<double>(problem.grid.cell_count());
}

class WorkCounter {
public:
    explicit WorkCounter(const StepProblem& problem)
        : problem_(problem),
          word_(problem.precision == Precision::single ? sizeof(float) : sizeof(double)) {
        work_.links = links_of(problem);
    }

    StepWork count() {
        for (const StepProblem::Pass& pass : problem_.passes) add(pass);
        const auto cells = static_cast<double>(problem_.grid.cell_count());
        work_.passes = problem_.passes.size();
        work_.working_set = cells * (static_cast<double>(touched_.size()) * word_ +
                                     static_cast<double>(masks_.size()) + link_bytes_);
        return work_;
    }

private:
    void add(const StepProblem::Pass& pass) {
        for (const StepProblem::Reduction& reduction : pass.reductions) add(reduction);
        if (pass.filter || !pass.convolutions.empty() || !pass.solves.empty())
            work_.has_waves = true;
        CHECK(pass.source, "what a pass computes is known");
        const KernelCost cost = cost_of(*pass.source, problem_.grid.stencil(), work_.links);
        work_.cost += cost;
        // Two slots may refer to the same plane, which is read only once.
        const std::set<StepProblem::PlaneRef> read(pass.fields.begin(), pass.fields.end());
        touched_.insert(read.begin(), read.end());
        for (const auto& result : pass.results) touched_.insert(result.plane);
        masks_.insert(pass.masks.begin(), pass.masks.end());
        work_.bytes += static_cast<double>(read.size() + pass.results.size()) * word_ +
                       static_cast<double>(pass.masks.size()) + cost.link_bytes;
        link_bytes_ = std::max(link_bytes_, cost.link_bytes);
    }

    /// Counts a reduction as a tree over the cells, in which each cell is loaded and combined once.
    void add(const StepProblem::Reduction& reduction) {
        work_.cost.operations += 1;
        work_.cost.loads += 1;
        work_.cost.load_bytes += word_;
        work_.bytes += word_;
        touched_.insert(reduction.operand);
    }

    const StepProblem& problem_;
    double word_;            ///< The bytes of a number.
    double link_bytes_ = 0;  ///< The bytes of links per cell, in the pass that reads the most.
    std::set<StepProblem::PlaneRef> touched_;
    std::set<const Mask*> masks_;
    StepWork work_;
};

}  // namespace

StepWork work_of(const StepProblem& problem) { return WorkCounter(problem).count(); }

}  // namespace cascade
