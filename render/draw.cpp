// Distributes tiles to the threads of a team.
#include "render/draw.h"

#include "picture/srgb.h"
#include "render/tile_drawer.h"
#include "render/tracer.h"

#include <algorithm>
#include <atomic>

namespace cascade {

Image draw(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options,
           Team& team) {
    const Tracer tracer(caster, look, options);
    Image image(options.width, options.height);
    if (!options.background) image.alpha.resize(image.pixels.size());
    const std::int64_t columns = (options.width + TileDrawer::side - 1) / TileDrawer::side;
    const std::int64_t rows = (options.height + TileDrawer::side - 1) / TileDrawer::side;
    const std::int64_t tiles = columns * rows;
    std::atomic<std::int64_t> next{0};
    team.run([&](int thread) {
        TileDrawer drawer(tracer, options);
        for (std::int64_t tile = next++; tile < tiles; tile = next++) {
            drawer.draw(tile % columns * TileDrawer::side, tile / columns * TileDrawer::side,
                        image);
            if (thread != 0 || !options.report) continue;
            // A tile of another thread counts as done as soon as the thread begins it.
            const double part =
                static_cast<double>(std::min(next.load(), tiles)) / static_cast<double>(tiles);
            if (!options.report(part)) next = tiles;
        }
    });
    return image;
}

Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team) {
    const RayCaster caster(mesh);
    const auto look = [&](const Sight& sight) {
        Look result;
        result.light = colour(sight.hit);
        for (float& channel : result.light) channel = light_of(channel);
        return result;
    };
    return draw(caster, look, options, team);
}

}  // namespace cascade
