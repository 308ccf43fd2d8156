// Finds the waves that grow in a growing domain, at several times of a stage.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::analysis {

/// The waves that grow at one time. Along x, or on a sphere, `least`, `most` and `fastest` count
/// the waves that fit: half waves between sides, whole waves on a periodic axis, the degree l of
/// spherical harmonics on a sphere. On other surfaces they are wavelengths.
struct WavesOfMoment {
    double least = 0, most = 0, fastest = 0;
};

/// A time of a stage whose domain grows.
struct GrowingMoment {
    double t = 0;
    std::vector<double> lengths;         ///< The lengths of growing_sides().
    bool has_state = false;              ///< Whether a flat state was found.
    std::optional<WavesOfMoment> waves;  ///< Empty if no wave grows, or if none of them fits.
    bool none_fits = false;              ///< Whether waves grow, but none of them fits.
};

/// Looks at five times of a stage, from its start to its end, which growing waves fit into the
/// domain. Empty if lengths do not change, if the stage's duration is not known before the run, or
/// if the stage cannot be analysed.
std::vector<GrowingMoment> moments_of_growing_domain(const Program& program, std::uint32_t stage);

/// The same as lines of text. Empty if there are no moments.
std::string waves_of_growing_domain(const Program& program, std::uint32_t stage);

/// What `least`, `most` and `fastest` count: "half waves", "waves", "degrees" or "lengths".
std::string_view counted_waves(const DomainSettings& domain);

}  // namespace cascade::analysis
