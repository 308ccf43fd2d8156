#include "solvers/tile_tuner.h"

#include "core/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

constexpr int rounds = 3;
// Long enough for a clock, and for the caches to fill with what a tiling keeps there.
constexpr double trial_seconds = 0.002;
// First steps meet cold caches, and threads that wake up.
constexpr double warm_up_seconds = 0.01;
// So much of a run may trials take that bring nothing: those of the first round.
constexpr double share_of_run = 0.02;
// So much less time must a sweep take to be clearly faster.
constexpr double clearly_faster = 0.95;

}  // namespace

TileTuner::TileTuner(std::vector<Tiling> candidates, TilingMemory* memory, int threads)
    : candidates_(std::move(candidates)), memory_(memory), threads_(threads) {
    CHECK(!candidates_.empty(), "there is a way to go through memory");
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
        tried_.push_back({k});
        most_levels_ = std::max(most_levels_, candidates_[k].levels);
    }
    if (memory_ != nullptr && candidates_.size() > 1) recall();
}

/// What is none of the candidates was kept for other steps.
void TileTuner::recall() {
    const std::optional<Tiling> known = memory_->find(threads_);
    const auto found = known ? std::find(candidates_.begin(), candidates_.end(), *known) : candidates_.end();
    if (found == candidates_.end()) return;
    current_ = static_cast<std::size_t>(found - candidates_.begin());
    state_ = State::recalled;
}

std::string TileTuner::how_found() const {
    if (state_ == State::recalled) return "the fastest in an earlier run";
    return state_ == State::found ? fmt::format("the fastest of {} ways", candidates_.size()) : "";
}

std::int64_t TileTuner::sweeps_of_trial() const {
    const double tiles = std::ceil(trial_seconds / (seconds_per_sweep_ * most_levels_));
    return most_levels_ * static_cast<std::int64_t>(std::clamp(tiles, 1.0, 1e9));
}

void TileTuner::took(std::int64_t sweeps, Seconds duration, Seconds left) {
    const double seconds = std::max(duration.count(), 1e-9);
    if (state_ == State::waiting && candidates_.size() > 1) {
        warm_seconds_ += seconds;
        seconds_per_sweep_ = seconds / static_cast<double>(sweeps);
        const double trial = seconds_per_sweep_ * static_cast<double>(sweeps_of_trial());
        const double cost = trial * static_cast<double>(candidates_.size());
        if (warm_seconds_ >= warm_up_seconds && cost <= share_of_run * left.count()) state_ = State::trying;
    } else if (state_ == State::trying) {
        Tried& tried = tried_[turn_];
        tried.seconds += seconds;
        tried.sweeps += static_cast<double>(sweeps);
        if (tried.sweeps < most_levels_ || tried.seconds < trial_seconds) return;
        if (++turn_ == tried_.size()) end_round();
        current_ = tried_[turn_].candidate;
    }
}

void TileTuner::end_round() {
    const double most = clearly_faster * tried_[0].seconds_per_sweep();
    std::erase_if(tried_, [&](const Tried& tried) {
        return tried.candidate != 0 && tried.seconds_per_sweep() > most;
    });
    for (Tried& tried : tried_) {
        tried.seconds_in_all += tried.seconds_per_sweep();
        tried.seconds = tried.sweeps = 0;
    }
    turn_ = 0;
    if (++round_ < rounds && tried_.size() > 1) return;
    tried_ = {*std::min_element(tried_.begin(), tried_.end(), [](const Tried& a, const Tried& b) {
        return a.seconds_in_all < b.seconds_in_all;
    })};
    state_ = State::found;
    if (memory_ != nullptr) memory_->keep(threads_, candidates_[tried_[0].candidate]);
}

}  // namespace cascade
