// Joins charts along common edges (internal to atlas/).
#pragma once

#include "atlas/chart.h"
#include "core/parallel.h"

#include <atomic>
#include <cstddef>
#include <new>

namespace cascade {

/// Calls `work(k)` for k from 0 to count − 1 on the threads of a team, until `cancel` becomes true.
/// Throws std::bad_alloc if a call throws it.
template <typename Work>
void in_turn(Team& team, std::size_t count, const std::atomic<bool>& cancel, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> lacks_memory = false;
    team.run([&](int) {
        try {
            for (std::size_t k = next++; k < count && !cancel && !lacks_memory; k = next++) work(k);
        } catch (const std::bad_alloc&) {
            lacks_memory = true;
        }
    });
    if (lacks_memory) throw std::bad_alloc();
}

/// Whether a chart has no overlaps, is at most 1.5 long and has little distortion. Small charts are
/// allowed more distortion. The unit of length is the square root of the surface's area.
bool is_good(const SurfaceMesh& mesh, const Seams& seams, const Chart& chart);

/// Joins charts as long as the joined charts fulfil is_good(), and removes the seams between them.
std::vector<Chart> join_charts(const SurfaceMesh& mesh, std::vector<Chart> charts, Seams& seams,
                               std::span<std::uint32_t> numbers, Team& team,
                               const std::atomic<bool>& cancel);

}  // namespace cascade
