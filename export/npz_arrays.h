// The arrays of a NumPy archive (.npz).
#pragma once

#include "core/palette.h"
#include "export/channels.h"
#include "export/zip.h"
#include "picture/float_bytes.h"
#include "picture/npy.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// Collects the arrays of an archive.
class NpzArrays {
public:
    /// Adds an array of rows × columns, or of rows if `columns` is 1. `type` is NumPy's name of the
    /// type.
    template <typename Number, typename Take>
    void add(const std::string& name, std::string_view type, std::size_t rows, std::size_t columns,
             const Take& take) {
        const std::string shape =
            columns == 1 ? fmt::format("{},", rows) : fmt::format("{}, {}", rows, columns);
        ZipEntry entry{name + ".npy", npy_head(type, shape)};
        entry.bytes.reserve(entry.bytes.size() + rows * columns * sizeof(Number));
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                append_number(entry.bytes, static_cast<Number>(take(row, column)));
            }
        }
        entries_.push_back(std::move(entry));
    }

    void add_vectors(const std::string& name, std::span<const Vector3d> vectors) {
        add<double>(name, "<f8", vectors.size(), 3, [&](std::size_t row, std::size_t column) {
            const Vector3d& v = vectors[row];
            return column == 0 ? v.x : column == 1 ? v.y : v.z;
        });
    }

    void add_colours(const std::string& name, std::span<const Colour> colours) {
        add<float>(name, "<f4", colours.size(), 3, [&](std::size_t row, std::size_t column) {
            return shown(colours[row])[column];
        });
    }

    /// Adds channels under their names. Names in `reserved` get an underscore.
    void add_channels(std::span<const Channel> channels,
                      std::initializer_list<std::string_view> reserved) {
        const std::vector<std::string> names = distinct_names(channels, reserved);
        for (std::size_t c = 0; c < names.size(); ++c) {
            const std::vector<float>& values = channels[c].values;
            add<float>(names[c], "<f4", values.size(), 1,
                       [&](std::size_t row, std::size_t) { return values[row]; });
        }
    }

    std::span<const ZipEntry> entries() const { return entries_; }

private:
    std::vector<ZipEntry> entries_;
};

}  // namespace cascade
