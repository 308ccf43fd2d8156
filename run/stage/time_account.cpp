// The clock is read whenever a scope begins or ends. The time since the last reading goes to the
// scope in which the time has passed.
#include "run/stage/time_account.h"

#include "core/processor_time.h"

#include <numeric>
#include <utility>

namespace cascade {

TimeAccount::TimeAccount() : before_(processor_seconds()), since_(Clock::now()) {}

TimeAccount::Scope::Scope(TimeAccount* account, Spent what, std::optional<std::uint32_t> stage)
    : account_(account) {
    if (account_ == nullptr) return;
    account_->settle();
    if (!stage) stage = account_->stage_;
    what_ = std::exchange(account_->what_, what);
    stage_ = std::exchange(account_->stage_, stage);
}

TimeAccount::Scope::~Scope() {
    if (account_ == nullptr) return;
    account_->settle();
    account_->what_ = what_;
    account_->stage_ = stage_;
}

TimeAccount::Stage& TimeAccount::stage(std::uint32_t number) {
    if (number >= stages_.size()) stages_.resize(number + 1);
    return stages_[number];
}

void TimeAccount::settle() {
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - std::exchange(since_, now)).count();
    auto& seconds = stage_ ? stage(*stage_).seconds : outside_;
    seconds[static_cast<std::size_t>(what_)] += passed;
}

double TimeAccount::seconds(Spent what) {
    settle();
    const auto at = static_cast<std::size_t>(what);
    double sum = outside_[at];
    for (const Stage& stage : stages_) sum += stage.seconds[at];
    return sum;
}

double TimeAccount::seconds() {
    settle();
    double sum = std::accumulate(outside_.begin(), outside_.end(), 0.0);
    for (const Stage& stage : stages_) {
        sum = std::accumulate(stage.seconds.begin(), stage.seconds.end(), sum);
    }
    return sum;
}

}  // namespace cascade
