// The input of baking: the look of a surface at the samples of a texture.
#pragma once

#include "atlas/texture_layout.h"
#include "core/palette.h"
#include "export/material.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace cascade {

/// Consecutive samples of a texture's row in one triangle, and the memory for their looks.
struct SampleRow {
    const TextureLayout& layout;
    std::uint32_t triangle = 0;
    std::int64_t first = 0, row = 0;     ///< Position of the first sample.
    std::span<Colour> lights;            ///< Reflected fractions, 0 … 1 (light_of).
    std::span<float> heights;            ///< Above the surface, in the unit of the mesh.
    std::span<OfParts<float>> material;  ///< Emission as light.

    SurfacePlace place(std::size_t k) const {
        return layout.place_at(triangle, first + static_cast<std::int64_t>(k), row);
    }
};

/// Paints samples. Not thread-safe, so each thread has its own.
class SamplePainter {
public:
    SamplePainter() = default;
    virtual ~SamplePainter() = default;
    SamplePainter(const SamplePainter&) = delete;
    SamplePainter& operator=(const SamplePainter&) = delete;

    /// The maps it paints besides colours. Without heights all are 0.
    virtual MapSet maps() const = 0;

    /// Sets all lights, and heights and material as far as maps() has them.
    virtual void paint(const SampleRow& row) = 0;

    /// A vector along the normal of the surface raised by the heights, for the samples of one
    /// texel, at least one. `normal` is the surface's in their middle.
    virtual Vector3d raised_normal(std::span<const SurfacePlace> samples,
                                   const Vector3d& normal) = 0;
};

using MakeSamplePainter = std::function<std::unique_ptr<SamplePainter>()>;

}  // namespace cascade
