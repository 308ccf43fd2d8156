// A state machine driven by the times of batches. The tuner rests, or tries the candidates round by
// round.
#include "solvers/tile_tuner.h"

#include "core/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

constexpr int rounds = 3;
// Duration of a candidate's turn. Long enough for a tiling to fill the caches.
constexpr double turn_seconds = 0.002;
// Duration of a batch in a trial. Long enough for a clock, and shorter than the time slice of
// another program.
constexpr double trial_batch_seconds = 0.00025;
// Trials begin after this time, because at first caches are cold and threads are waking up.
constexpr double warm_up_seconds = 0.01;
// The fraction of a run that the first round of trials may cost.
constexpr double share_of_run = 0.02;
// The fraction of the time since the last trials that new trials may cost. Trials that lead to no
// change become rarer, so they cost less.
constexpr double share_of_rest = 0.005;
constexpr double most_patience = 64;
// A sweep is clearly faster if it takes less than this fraction of the time.
constexpr double clearly_faster = 0.95;

}  // namespace

TileTuner::TileTuner(std::vector<Tiling> candidates, TilingMemory* memory, int threads)
    : candidates_(std::move(candidates)), memory_(memory), threads_(threads) {
    CHECK(!candidates_.empty(), "there is a way to go through memory");
    for (const Tiling& tiling : candidates_) most_levels_ = std::max(most_levels_, tiling.levels);
    if (memory_ != nullptr && candidates_.size() > 1) recall();
}

/// Begins with the stored tiling. If that tiling is not among the candidates, it was found for
/// other steps and is ignored.
void TileTuner::recall() {
    const std::optional<Tiling> known = memory_->find(threads_);
    const auto found =
        known ? std::find(candidates_.begin(), candidates_.end(), *known) : candidates_.end();
    if (found == candidates_.end()) return;
    current_ = static_cast<std::size_t>(found - candidates_.begin());
    choice_ = Choice::recalled;
}

std::string TileTuner::how_found() const {
    if (choice_ == Choice::recalled) return "the fastest in an earlier run";
    return choice_ == Choice::by_time ? fmt::format("the fastest of {} ways", candidates_.size())
                                      : "";
}

/// The smallest number of sweeps, in whole tiles, that takes at least this time.
std::int64_t TileTuner::sweeps_in(double seconds) const {
    const double tiles = std::ceil(seconds / (seconds_per_sweep_ * most_levels_));
    return most_levels_ * static_cast<std::int64_t>(std::clamp(tiles, 1.0, 1e9));
}

std::int64_t TileTuner::sweeps_of_trial() const { return sweeps_in(trial_batch_seconds); }

bool TileTuner::is_due(double left) const {
    if (candidates_.size() < 2 || rested_seconds_ < warm_up_seconds) return false;
    const double turn = seconds_per_sweep_ * static_cast<double>(sweeps_in(turn_seconds));
    const double cost = turn * static_cast<double>(candidates_.size());
    return cost <= share_of_run * left &&
           (choice_ != Choice::by_time || patience_ * cost <= share_of_rest * rested_seconds_);
}

void TileTuner::took(std::int64_t sweeps, Seconds duration, Seconds left) {
    const double seconds = std::max(duration.count(), 1e-9);
    if (!is_trying_) {
        rested_seconds_ += seconds;
        seconds_per_sweep_ = std::min(seconds_per_sweep_, seconds / static_cast<double>(sweeps));
        if (is_due(left.count())) begin();
        return;
    }
    Tried& tried = tried_[turn_];
    tried.sweeps += sweeps;
    tried.least = std::min(tried.least, seconds / static_cast<double>(sweeps));
    if (tried.sweeps < sweeps_of_turn_) return;
    if (++turn_ == tried_.size()) end_round();
    if (is_trying_) current_ = tried_[turn_].candidate;
}

void TileTuner::begin() {
    is_trying_ = true;
    round_ = 0;
    turn_ = 0;
    sweeps_of_turn_ = sweeps_in(turn_seconds);
    used_before_ = current_;
    tried_.clear();
    for (std::size_t k = 0; k < candidates_.size(); ++k) tried_.push_back({k});
    current_ = tried_[0].candidate;
}

void TileTuner::end_round() {
    const double most = clearly_faster * tried_[0].least;
    const auto is_slow = [&](const Tried& tried) { return tried.least > most; };
    tried_.erase(std::remove_if(tried_.begin() + 1, tried_.end(), is_slow), tried_.end());
    for (Tried& tried : tried_) {
        tried.least_in_all += tried.least;
        tried.least = never;
        tried.sweeps = 0;
    }
    turn_ = 0;
    if (++round_ < rounds && tried_.size() > 1) return;
    end(std::min_element(tried_.begin(), tried_.end(), [](const Tried& a, const Tried& b) {
            return a.least_in_all < b.least_in_all;
        })->candidate);
}

void TileTuner::end(std::size_t best) {
    const bool is_new = best != used_before_;
    if (memory_ != nullptr) memory_->keep(threads_, candidates_[best]);
    patience_ = is_new ? 1 : std::min(2 * patience_, most_patience);
    choice_ = Choice::by_time;
    current_ = best;
    is_trying_ = false;
    rested_seconds_ = 0;
    seconds_per_sweep_ = never;
}

}  // namespace cascade
