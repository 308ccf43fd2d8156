// Runs a grid in parts. Each part has only its own planes and the halos that it gets from other
// parts, as if the parts were processes on several machines. The time loop gets whole planes.
#include "core/parallel.h"
#include "solvers/executor.h"
#include "solvers/pass_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace cascade {
namespace {

class PartsExecutor final : public Executor {
public:
    PartsExecutor(const StepProblem& problem, std::vector<Field> species, int count, bool keeps,
                  std::int64_t thickness)
        : team_(static_cast<int>(cut_grid(problem.grid, count).size())),
          board_(team_, static_cast<std::size_t>(team_.size())) {
        const std::vector<RowRange> rows = cut_grid(problem.grid, team_.size());
        const int levels = levels_of_halo(problem, rows, thickness);
        for (std::size_t part = 0; part < rows.size(); ++part) {
            exchanges_.push_back(
                std::make_unique<LocalExchange>(problem.grid, rows, part, board_, levels));
            layouts_.push_back(layout_of(problem, exchanges_.back().get()));
            parts_.push_back(
                make_part_executor(problem, cut(species, part), 1, keeps, *exchanges_.back()));
        }
    }

    const StepProblem& problem() const override { return parts_[0]->problem(); }
    void prepare(const StepProblem& problem) override {
        for (const auto& part : parts_) part->prepare(problem);
    }

    const std::vector<Field>& fetch(int copy) override {
        return fetched_[copy] = whole([&](Executor & part) -> auto& { return part.fetch(copy); });
    }
    const std::vector<Field>& fetch(RegisterId scratch) override {
        return fetched_of_scratch_[scratch] =
                   whole([&](Executor & part) -> auto& { return part.fetch(scratch); });
    }
    std::vector<Field> take(int copy) override {
        return whole([&](Executor & part) -> auto& { return part.fetch(copy); });
    }
    void put(int copy, std::vector<Field> species) override {
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            parts_[part]->put(copy, cut(species, part));
        }
    }
    void exchange(RegisterId one, RegisterId other) override {
        for (const auto& part : parts_) part->exchange(one, other);
    }
    void fill_halos(int copy, SideMoment moment) override {
        on_all([&](std::size_t part) { parts_[part]->fill_halos(copy, moment); });
    }

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override {
        std::vector<std::uint8_t> finite(parts_.size());
        on_all([&](std::size_t part) {
            finite[part] = parts_[part]->run(clock, first, count, check, cancel);
        });
        return std::all_of(finite.begin(), finite.end(), [](std::uint8_t is) { return is != 0; });
    }
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override {
        std::vector<ErrorOfStep> errors;
        on_all([&](std::size_t part) {
            std::vector<ErrorOfStep> here = parts_[part]->run_judged(clock, first, cancel);
            if (part == 0) errors = std::move(here);
        });
        return errors;
    }
    bool is_finite(int copy) override {
        return std::all_of(parts_.begin(), parts_.end(),
                           [&](const auto& part) { return part->is_finite(copy); });
    }

    int most_threads() const override { return 1; }
    void use_threads(int) override {}
    std::vector<Tiling> tilings_to_try() const override { return parts_[0]->tilings_to_try(); }
    void use_tiling(const Tiling& tiling) override {
        for (const auto& part : parts_) part->use_tiling(tiling);
    }
    int levels() const override { return parts_[0]->levels(); }
    Stepping stepping() const override {
        Stepping stepping = parts_[0]->stepping();
        stepping.words = fmt::format("{} parts, {} passes between two exchanges of halos",
                                     parts_.size(), exchanges_[0]->levels());
        stepping.why = gathers() ? "one of them computes what takes all cells" : "";
        return stepping;
    }

private:
    void on_all(const std::function<void(std::size_t part)>& work) {
        team_.run([&](int part) { work(static_cast<std::size_t>(part)); });
    }

    bool gathers() const {
        const std::vector<StepProblem::Pass>& passes = problem().passes;
        return std::any_of(passes.begin(), passes.end(), [](const StepProblem::Pass& pass) {
            return !pass.solves.empty() || !pass.convolutions.empty() || pass.filter;
        });
    }

    std::vector<Field> cut(const std::vector<Field>& species, std::size_t part) const {
        std::vector<Field> own;
        for (const Field& field : species) {
            copy_held(field, own.emplace_back(layouts_[part], field.precision()));
        }
        return own;
    }

    std::vector<Field> whole(
        const std::function<const std::vector<Field>&(Executor& part)>& planes_of) {
        std::vector<Field> all;
        for (const Field& field : planes_of(*parts_[0])) {
            all.emplace_back(PlaneLayout(problem().grid), field.precision());
        }
        on_all([&](std::size_t part) {
            std::vector<const Field*> own;
            std::vector<Field*> to;
            for (const Field& field : planes_of(*parts_[part])) own.push_back(&field);
            for (Field& field : all) to.push_back(&field);
            exchanges_[part]->gather(own, to);
        });
        fill_across(problem(), all);
        return all;
    }

    Team team_;  ///< A thread for each part.
    LocalExchange::Board board_;
    std::vector<std::unique_ptr<LocalExchange>> exchanges_;
    std::vector<PlaneLayout> layouts_;
    std::vector<std::unique_ptr<Executor>> parts_;
    std::map<int, std::vector<Field>> fetched_;
    std::map<RegisterId, std::vector<Field>> fetched_of_scratch_;
};

}  // namespace

MakeExecutor in_parts(int count, std::int64_t thickness) {
    return [=](const StepProblem& problem, std::vector<Field> species, int, bool keeps) {
        return std::make_unique<PartsExecutor>(problem, std::move(species), count, keeps,
                                               thickness);
    };
}

}  // namespace cascade
