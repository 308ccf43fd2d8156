// VTK's .vtp files: points with data, such as the cells of a surface or the corners of triangles.
// The format is "VTK File Formats", XML PolyData with one appended raw block (The VTK User's Guide,
// 11th edition, Kitware 2010, chapter 19).
#pragma once

#include "core/quaternion.h"
#include "export/channels.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace cascade {

struct VtpPoints {
    std::span<const Vector3d> places;
    std::span<const Vector3d> normals;
    std::span<const Colour> colours;  ///< May be empty.
    std::span<const double> areas;    ///< One per cell. May be empty.
    std::span<const double> radii;    ///< One per cell. May be empty.
    /// One per cell, written as `frame`, w first. May be empty.
    std::span<const Quaternion> frames;
    std::span<const Channel> channels;
    /// The triangles between the points. If empty, each point is a vertex.
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// The bytes of the file. Positions are Float32, or Float64 if Float32 would not be exact.
std::string encode_vtp(const VtpPoints& points);

}  // namespace cascade
