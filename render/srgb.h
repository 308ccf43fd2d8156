// Colours as pictures store them (sRGB) and the amounts of light that they mean: IEC 61966-2-1.
#pragma once

namespace cascade {

/// Of a channel 0 … 1. The same bits on every processor.
float light_of(float stored);

/// The other way; what is below 0 or above 1 is clamped.
float stored_of(float light);

/// base ^ exponent, computed in binary64: the library's functions of binary32 differ in their last
/// bit from processor to processor, those of binary64, rounded, do not.
float steady_power(float base, double exponent);

}  // namespace cascade
