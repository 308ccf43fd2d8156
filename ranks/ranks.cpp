// Compares the texts of ranks, and ends all ranks together.
#include "ranks/ranks.h"

#include "core/hash.h"
#include "ranks/launcher.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace cascade {

namespace {

constexpr auto between_comparisons = std::chrono::seconds(10);

}  // namespace

Ranks::Ranks(Messenger& messenger)
    : messenger_(messenger),
      compared_(static_cast<std::size_t>(messenger.count())),
      is_told_(compared_.size()) {
    const std::string name = this_machine();
    name.copy(load_.machine.data(), load_.machine.size() - 1);
}

std::vector<RankLoad> Ranks::loads() {
    std::vector<RankLoad> all(static_cast<std::size_t>(count()));
    all[static_cast<std::size_t>(rank())] = load_;
    std::vector<std::span<std::byte>> blocks;
    for (RankLoad& each : all) blocks.push_back(std::as_writable_bytes(std::span(&each, 1)));
    messenger_.complete(blocks);
    return all;
}

bool Ranks::is_time_to_compare() const {
    return std::chrono::steady_clock::now() - compared_at_ >= between_comparisons;
}

void Ranks::compare_loads() {
    compared_at_ = std::chrono::steady_clock::now();
    const std::vector<RankLoad> now = loads();
    std::vector<double> seconds;
    for (std::size_t k = 0; k < now.size(); ++k) {
        seconds.push_back(now[k].computing - compared_[k].computing);
    }
    compared_ = now;
    const auto slow = slow_rank(seconds);
    if (!slow || !tell_slow_ || is_told_[slow->rank]) return;
    is_told_[slow->rank] = true;
    tell_slow_(
        fmt::format("rank {} of {} on {} takes {:.1f} times as long for its steps as the "
                    "median of all ranks, and the others wait for it",
                    slow->rank, count(), now[slow->rank].machine.data(), slow->times));
}

Result<void> Ranks::compare(std::string_view what, std::string_view text) {
    const std::array own{fnv1a(text), static_cast<std::uint64_t>(text.size())};
    std::array first = own;
    messenger_.broadcast(std::as_writable_bytes(std::span(first)));
    if (first == own) return {};
    return failure(fmt::format("this rank and rank 0 do not have the same {}", what),
                   "all ranks need the same program, files and options, and a folder that all of "
                   "them see");
}

std::int64_t Ranks::most_parts(const Grid& grid) {
    return grid.depth > 1 ? grid.depth : grid.height;
}

int Ranks::finish(int status) {
    messenger_.broadcast(std::as_writable_bytes(std::span(&status, 1)));
    messenger_.finish();
    return is_root() ? status : 0;
}

std::string name_of_rank(const Ranks& ranks) {
    return fmt::format("rank {} of {} on {}", ranks.rank(), ranks.count(), this_machine());
}

}  // namespace cascade
