// Palettes as arithmetic.
#include "core/check.h"
#include "core/palette.h"
#include "lang/lower/lower_formula.h"

namespace cascade::lowering {

/// A palette is a sum of ramps, one for each stretch between two stops:
///
///     colour = c0 + Σ (c[k+1] − c[k]) · clamp(position · (n − 1) − k, 0, 1)
///
/// A position that is no number gives colour_of_nan.
Value KernelAssembly::palette(const Node& node, const Cursor& cursor) {
    const Palette* palette = find_palette(program_.literals->texts()[cursor.operand(3).index]);
    CHECK(palette != nullptr, "lowering: the checker has found every palette");
    const ValueId low = cursor.number(node, 1);
    const ValueId range = builder_.subtract(cursor.number(node, 2), low);
    const ValueId position = builder_.divide(builder_.subtract(cursor.number(node, 0), low), range);
    const std::span<const Colour> stops = palette->stops;
    const ValueId zero = builder_.number(0);
    const ValueId one = builder_.number(1);
    const ValueId scaled =
        builder_.multiply(position, builder_.number(static_cast<float>(stops.size() - 1)));
    Value colour{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        colour[channel] = builder_.number(stops[0][channel]);
    }
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const ValueId start = builder_.number(static_cast<float>(k));
        const ValueId ramp =
            builder_.clamp_above(builder_.clamp_below(builder_.subtract(scaled, start), zero), one);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const ValueId rise = builder_.number(stops[k + 1][channel] - stops[k][channel]);
            colour[channel] = builder_.add(colour[channel], builder_.multiply(rise, ramp));
        }
    }
    const ValueId is_number = builder_.apply(Op::equal, position, position);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        colour[channel] =
            builder_.select(is_number, colour[channel], builder_.number(colour_of_nan[channel]));
    }
    return colour;
}

}  // namespace cascade::lowering
