// Compares the texts of ranks, and ends all ranks together.
#include "ranks/ranks.h"

#include "core/hash.h"

#include <fmt/format.h>

#include <array>
#include <unistd.h>

namespace cascade {

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
    std::array<char, 256> machine{};
    if (::gethostname(machine.data(), machine.size() - 1) != 0) machine[0] = '?';
    return fmt::format("rank {} of {} on {}", ranks.rank(), ranks.count(), machine.data());
}

}  // namespace cascade
