// The loop over cells and their neighbours. This file is compiled for this machine, with separate
// flags.
#include "bench/straight_tissue.h"

#include <cmath>

namespace cascade::bench {

void straight_rates(const StraightTissue& t) {
    std::size_t link = 0;
    for (std::size_t i = 0; i < t.ends.size(); ++i) {
        float to_x = 0, to_y = 0, to_z = 0, turn_x = 0, turn_y = 0, turn_z = 0;
        for (; link < t.ends[i]; ++link) {
            const std::uint32_t j = t.neighbours[link];
            const float dx = t.x[j] - t.x[i], dy = t.y[j] - t.y[i], dz = t.z[j] - t.z[i];
            const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
            const float both = t.radius[i] + t.radius[j];
            if (!(distance < bench_reach * both)) continue;
            const float gap = distance - both;
            const float force = gap * (gap < 0 ? bench_push : bench_stick) / distance;
            to_x += force * dx;
            to_y += force * dy;
            to_z += force * dz;
            turn_x += t.axis_y[i] * t.axis_z[j] - t.axis_z[i] * t.axis_y[j];
            turn_y += t.axis_z[i] * t.axis_x[j] - t.axis_x[i] * t.axis_z[j];
            turn_z += t.axis_x[i] * t.axis_y[j] - t.axis_y[i] * t.axis_x[j];
        }
        t.to_x[i] = to_x;
        t.to_y[i] = to_y;
        t.to_z[i] = to_z;
        t.turn_x[i] = turn_x;
        t.turn_y[i] = turn_y;
        t.turn_z[i] = turn_z;
    }
}

}  // namespace cascade::bench
