// Takes the steps of one rank's part of the grid. When the time loop asks for planes, all ranks
// complete them together, so that the loop sees whole planes.
#include "ranks/rank_exchange.h"
#include "ranks/ranks.h"
#include "solvers/pass_runner.h"
#include "solvers/shared_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace cascade {
namespace {

class RanksExecutor final : public Executor, public SharedSteps {
public:
    /// The data that the executors of all stages share.
    struct Shared {
        Messenger& messenger;
        Ranks& ranks;
        std::atomic<bool>& cancel;
    };

    RanksExecutor(const StepProblem& problem, std::vector<Field> species, int most_threads,
                  bool keeps, const Shared& shared)
        : shared_(shared),
          exchange_(problem.grid, shared.messenger, shared.ranks.load(),
                    levels_of_halo(problem, cut_grid(problem.grid, shared.messenger.count()))),
          layout_(layout_of(problem, &exchange_)),
          part_(make_part_executor(problem, cut(species), most_threads, keeps, exchange_)) {}

    SharedSteps* shared_steps() override { return this; }
    const StepProblem& problem() const override { return part_->problem(); }
    void prepare(const StepProblem& problem) override { part_->prepare(problem); }

    const std::vector<Field>& fetch(int copy) override {
        return fetched_[copy] = whole(part_->fetch(copy));
    }
    const std::vector<Field>& fetch(RegisterId scratch) override {
        return fetched_of_scratch_[scratch] = whole(part_->fetch(scratch));
    }
    std::vector<Field> take(int copy) override { return whole(part_->fetch(copy)); }
    void put(int copy, std::vector<Field> species) override {
        forget();
        part_->put(copy, cut(species));
    }
    void exchange(RegisterId one, RegisterId other) override {
        forget();
        part_->exchange(one, other);
    }
    void fill_halos(int copy, SideMoment moment) override { part_->fill_halos(copy, moment); }

    // A step is never abandoned, because all ranks would have to abandon it at the same moment.

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>*) override {
        forget();
        const TimeOfSteps time(shared_.ranks.load());
        const bool is_finite = part_->run(clock, first, count, check, nullptr);
        return check ? exchange_.all_agree(is_finite) : is_finite;
    }
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>*) override {
        forget();
        const TimeOfSteps time(shared_.ranks.load());
        return part_->run_judged(clock, first, nullptr);
    }
    bool is_finite(int copy) override {
        const TimeOfSteps time(shared_.ranks.load());
        return exchange_.all_agree(part_->is_finite(copy));
    }

    LoopDecision agree(LoopDecision own) override {
        std::array<std::int64_t, 5> words = {own.steps, own.is_looked_at, own.is_kept,
                                             shared_.ranks.end_flag(),
                                             shared_.ranks.is_time_to_compare()};
        shared_.messenger.broadcast(std::as_writable_bytes(std::span(words)));
        if (words[3] != 0) shared_.cancel = true;
        if (words[4] != 0) shared_.ranks.compare_loads();
        return {words[0], words[1] != 0, words[2] != 0};
    }

    int most_threads() const override { return part_->most_threads(); }
    void use_threads(int threads) override { part_->use_threads(threads); }
    std::vector<Tiling> tilings_to_try() const override { return part_->tilings_to_try(); }
    void use_tiling(const Tiling& tiling) override { part_->use_tiling(tiling); }
    int levels() const override { return part_->levels(); }
    Stepping stepping() const override {
        Stepping stepping = part_->stepping();
        const RankLoad& load = shared_.ranks.load();
        stepping.words = fmt::format("{} ranks, rank 0 sent {} bytes of halos in {} exchanges",
                                     exchange_.count(), load.halo_bytes - bytes_before_,
                                     load.halo_exchanges - exchanges_before_);
        stepping.why = "";
        return stepping;
    }

private:
    /// Frees the memory of whole planes.
    void forget() {
        fetched_.clear();
        fetched_of_scratch_.clear();
    }

    std::vector<Field> cut(const std::vector<Field>& species) const {
        std::vector<Field> own;
        for (const Field& field : species) {
            copy_held(field, own.emplace_back(layout_, field.precision()));
        }
        return own;
    }

    std::vector<Field> whole(const std::vector<Field>& own) {
        std::vector<Field> all;
        for (const Field& field : own) {
            all.emplace_back(PlaneLayout(problem().grid), field.precision());
        }
        exchange_.gather_everywhere(own, all);
        fill_across(problem(), all);
        return all;
    }

    Shared shared_;
    const std::int64_t bytes_before_ = shared_.ranks.load().halo_bytes;
    const std::int64_t exchanges_before_ = shared_.ranks.load().halo_exchanges;
    RankExchange exchange_;
    PlaneLayout layout_;
    std::unique_ptr<Executor> part_;
    std::map<int, std::vector<Field>> fetched_;
    std::map<RegisterId, std::vector<Field>> fetched_of_scratch_;
};

}  // namespace

MakeExecutor Ranks::executor(std::atomic<bool>& cancel) {
    return [this, &cancel](const StepProblem& problem, std::vector<Field> species, int most_threads,
                           bool keeps) -> std::unique_ptr<Executor> {
        if (most_parts(problem.grid) < count()) {
            return make_thread_executor(problem, std::move(species), most_threads, keeps);
        }
        return std::make_unique<RanksExecutor>(problem, std::move(species), most_threads, keeps,
                                               RanksExecutor::Shared{messenger_, *this, cancel});
    };
}

}  // namespace cascade
