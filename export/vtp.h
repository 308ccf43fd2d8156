// VTK's .vtp files: points with data, as cells of a surface or as corners of triangles. The format:
// "VTK File Formats", XML PolyData with one appended raw block (The VTK User's Guide, 11th edition,
// Kitware 2010, chapter 19).
#pragma once

#include "export/channels.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace cascade {

struct VtpPoints {
    std::span<const Vector3d> places;
    std::span<const Vector3d> normals;
    std::span<const Colour> colours;  ///< Empty: none.
    std::span<const double> areas;    ///< Of cells; empty: none.
    std::span<const Channel> channels;
    /// Between the points; where there are none each point is a vertex of its own.
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// The file in memory. Places are Float32, or Float64 where that is not exact.
std::string encode_vtp(const VtpPoints& points);

}  // namespace cascade
