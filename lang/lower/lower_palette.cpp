// Computes palettes by arithmetic operations.
#include "core/check.h"
#include "core/palette.h"
#include "lang/lower/lower_node.h"

namespace cascade::lowering {

/// A palette is a sum of ramps, one for each section between two adjacent stops:
///
///     colour = c0 + Σ (c[k+1] − c[k]) · clamp(position · (n − 1) − k, 0, 1)
///
/// If the position is NaN, the colour is colour_of_nan.
Value lower_palette(KernelAssembly& assembly, const NodeInCell& in) {
    KernelBuilder& builder = assembly.builder();
    const Palette* palette =
        find_palette(assembly.program().literals->text(std::get<TextId>(in.operand(3).kind)));
    CHECK(palette != nullptr, "lowering: the checker has found every palette");
    const ValueId low = in.number(1);
    const ValueId range = builder.subtract(in.number(2), low);
    const ValueId position = builder.divide(builder.subtract(in.number(0), low), range);
    const std::span<const Colour> stops = palette->stops;
    const ValueId zero = builder.number(0);
    const ValueId one = builder.number(1);
    const ValueId scaled =
        builder.multiply(position, builder.number(static_cast<float>(stops.size() - 1)));
    Value colour{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        colour[channel] = builder.number(stops[0][channel]);
    }
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const ValueId start = builder.number(static_cast<float>(k));
        const ValueId ramp =
            builder.clamp_above(builder.clamp_below(builder.subtract(scaled, start), zero), one);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const ValueId rise = builder.number(stops[k + 1][channel] - stops[k][channel]);
            colour[channel] = builder.add(colour[channel], builder.multiply(rise, ramp));
        }
    }
    const ValueId is_number = builder.apply(Op::equal, position, position);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        colour[channel] =
            builder.select(is_number, colour[channel], builder.number(colour_of_nan[channel]));
    }
    return colour;
}

}  // namespace cascade::lowering
