// The appearance of a surface at the samples of a texture, which baking paints.
#pragma once

#include "atlas/texture_layout.h"
#include "core/palette.h"
#include "export/material.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace cascade {

/// Consecutive samples in a row of the texture, all in one triangle, and the memory for their
/// painted values.
struct SampleRow {
    const TextureLayout& layout;
    std::uint32_t triangle = 0;
    std::int64_t first = 0, row = 0;     ///< Position of the first sample.
    std::span<Colour> lights;            ///< Reflected fractions of light, 0 … 1 (light_of).
    std::span<float> heights;            ///< Heights above the surface, in the unit of the mesh.
    std::span<OfParts<float>> material;  ///< The material, with emission as light.

    SurfacePlace place(std::size_t k) const {
        return layout.place_at(triangle, first + static_cast<std::int64_t>(k), row);
    }
};

/// Paints samples. Not thread-safe, so each thread has its own painter.
class SamplePainter {
public:
    SamplePainter() = default;
    virtual ~SamplePainter() = default;
    SamplePainter(const SamplePainter&) = delete;
    SamplePainter& operator=(const SamplePainter&) = delete;

    /// The maps that this painter gives, besides colours. Without a map of heights, all heights
    /// are 0.
    virtual MapSet maps() const = 0;

    /// Sets all lights of the row, and the heights and the parts of the material that are in
    /// maps().
    virtual void paint(const SampleRow& row) = 0;

    /// A vector, of any length, along the normal of the surface raised by the heights. `samples`
    /// are samples of one texel, of which there is at least one. `normal` is the normal of the
    /// unraised surface at their middle.
    virtual Vector3d raised_normal(std::span<const SurfacePlace> samples,
                                   const Vector3d& normal) = 0;
};

using MakeSamplePainter = std::function<std::unique_ptr<SamplePainter>()>;

}  // namespace cascade
