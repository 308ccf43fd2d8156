// For each row of samples, interpolates first between the rows of cells, then between columns.
#include "export/plane_maps.h"

#include "core/between_cells.h"
#include "core/check.h"
#include "core/wide_vectors.h"
#include "export/channels.h"
#include "export/fill_gaps.h"
#include "export/map_texels.h"
#include "mesh/triangle_mesh.h"
#include "picture/srgb.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

/// The position of a sample between cells, along one axis.
struct SamplePlace {
    std::int64_t before = 0;  ///< The last cell whose centre is before the sample; may be −1.
    float part = 0;           ///< The fraction of the way to the next cell.
};

SamplePlace place_of_sample(std::int64_t sample, std::int64_t samples, std::int64_t cells) {
    const double place = (static_cast<double>(sample) + 0.5) * static_cast<double>(cells) /
                             static_cast<double>(samples) -
                         0.5;
    const double before = std::floor(place);
    return {static_cast<std::int64_t>(before), static_cast<float>(place - before)};
}

/// Interpolates between rows of cells.
WITH_WIDE_VECTORS void blend_rows(const std::array<const float*, cells_between>& rows, float part,
                                  float* values, std::size_t count) {
    const auto [a, b, c, d, e, f] = rows;
    for (std::size_t k = 0; k < count; ++k) {
        values[k] = value_between<float>({a[k], b[k], c[k], d[k], e[k], f[k]}, part);
    }
}

/// The slopes in `count` adjacent cells. `line` begins two cells before the first one.
WITH_WIDE_VECTORS void find_slopes(const float* line, float* slopes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        slopes[k] = slope_in(line[k], line[k + 1], line[k + 2], line[k + 3], line[k + 4]);
    }
}

/// Interpolates between the cells of a line that have these values and slopes.
WITH_WIDE_VECTORS void blend_columns(const float* cells, const float* slopes,
                                     const std::int32_t* before, const float* parts,
                                     float* __restrict values, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const auto cell = before[k];
        values[k] =
            value_on_curve(cells[cell], cells[cell + 1], slopes[cell], slopes[cell + 1], parts[k]);
    }
}

/// The values of a plane's cells: the channels of colours, those parts of the material that are
/// given, and the height, if there is one. Interpolates them for one row of samples at a time.
class CellValues {
public:
    CellValues(const FlatCells& cells, const PaintedCells& painted)
        : cells_(cells), channels_(painted.channels), has_heights_(!painted.heights.empty()) {
        for (std::size_t k = 0; k < material_parts; ++k) {
            if (!painted.material[k].empty()) parts_.push_back(static_cast<MaterialPart>(k));
        }
        for (std::size_t c = 0; c < channels_; ++c) {
            add([&](std::size_t cell) { return painted.values[cell * channels_ + c]; });
        }
        for (const MaterialPart part : parts_) {
            add([&](std::size_t cell) { return painted.material[part][cell]; });
        }
        if (has_heights_) add([&](std::size_t cell) { return painted.heights[cell]; });
        for (std::size_t k = 0; k < size(); ++k) fill(k);
    }

    std::size_t size() const { return values_.size(); }
    std::span<const MaterialPart> parts() const { return parts_; }

    /// Interpolates value k of all columns between two rows of cells, and writes the results to
    /// `line`. The line has `margin` more cells at both ends.
    void row_at(std::size_t k, const SamplePlace& down, std::span<float> line) const {
        std::array<const float*, cells_between> rows{};
        for (std::size_t n = 0; n < rows.size(); ++n) {
            const std::int64_t row = cells_.row(down.before + static_cast<std::int64_t>(n) - 2);
            rows[n] = &values_[k][static_cast<std::size_t>(row * cells_.columns)];
        }
        const auto columns = static_cast<std::size_t>(cells_.columns);
        float* const first = &line[margin];
        blend_rows(rows, down.part, first, columns);
        for (std::int64_t beyond = 1; beyond <= margin; ++beyond) {
            *(first - beyond) = first[cells_.column(-beyond)];
            first[cells_.columns - 1 + beyond] = first[cells_.column(cells_.columns - 1 + beyond)];
        }
    }
    static constexpr std::int64_t margin = cells_between / 2;

private:
    template <typename Take>
    void add(const Take& take) {
        values_.emplace_back(cells_.count());
        put(values_.size() - 1, take);
    }

    template <typename Take>
    void put(std::size_t k, const Take& take) {
        for (std::size_t cell = 0; cell < cells_.count(); ++cell) values_[k][cell] = take(cell);
    }

    /// Replaces value k in cells outside the domain, and heights that are not finite, by values
    /// from the surroundings. Opacity is an exception: it is 0 outside the domain.
    void fill(std::size_t k) {
        const bool is_height = has_heights_ && k + 1 == size();
        const bool is_opacity =
            k >= channels_ && !is_height && parts_[k - channels_] == MaterialPart::opacity;
        PartialTexture texture(cells_.columns, cells_.rows);
        bool has_gap = false;
        for (std::size_t cell = 0; cell < cells_.count(); ++cell) {
            const float value = values_[k][cell];
            const bool counts =
                (is_opacity || cells_.is_inside(cell)) && (!is_height || std::isfinite(value));
            texture.texels[cell][0] = counts ? value : 0;
            texture.is_filled[cell] = counts ? 1 : 0;
            has_gap = has_gap || !counts;
        }
        if (!has_gap) return;
        fill_gaps(texture);
        put(k, [&](std::size_t cell) { return texture.texels[cell][0]; });
    }

    const FlatCells& cells_;
    std::size_t channels_;
    bool has_heights_;
    std::vector<MaterialPart> parts_;
    std::vector<std::vector<float>> values_;  ///< The values of all cells, one list per value.
};

class PlaneBaker {
public:
    PlaneBaker(const FlatCells& cells, const PaintedCells& painted,
               std::array<std::int64_t, 2> size)
        : cells_(cells), painted_(painted), values_(cells, painted) {
        const auto cells_of_texel = [](std::int64_t count, std::int64_t texels) {
            return (count + texels - 1) / texels;
        };
        samples_ = std::max({std::int64_t{2}, cells_of_texel(cells.columns, size[0]),
                             cells_of_texel(cells.rows, size[1])});
        for (std::int64_t i = 0; i < size[0] * samples_; ++i) {
            const auto [before, part] = place_of_sample(i, size[0] * samples_, cells.columns);
            before_.push_back(static_cast<std::int32_t>(before + 1));
            parts_.push_back(part);
        }
        const auto image = [size](bool is_there) {
            return is_there ? Image(size[0], size[1]) : Image();
        };
        maps_.maps = maps_of(painted.material, !painted.heights.empty());
        maps_.repeats = cells.repeats;
        maps_.is_cut = is_cut(painted.material[MaterialPart::opacity]);
        maps_.colour = image(true);
        maps_.surface = image(maps_.maps.has_surface());
        maps_.emission = image(maps_.maps.emission);
        maps_.opacity = image(maps_.maps.opacity);
        maps_.relief = image(maps_.maps.heights);
        maps_.normals = image(maps_.maps.normals);
    }

    MaterialMaps run(Team& team) {
        in_rows(team, [&](RowPainter& painter, std::int64_t y) { painter.paint(y); });
        if (!maps_.maps.heights) return std::move(maps_);
        in_rows(team, [&](RowPainter&, std::int64_t y) { find_normals(y); });
        ValueRange& range = maps_.heights;
        range = {maps_.relief.pixels[0][0], maps_.relief.pixels[0][0]};
        for (const Colour& texel : maps_.relief.pixels) {
            range.low = std::min(range.low, texel[0]);
            range.high = std::max(range.high, texel[0]);
        }
        store_heights(range, maps_.relief.pixels);
        return std::move(maps_);
    }

private:
    /// Paints rows of texels. Owns a thread's working memory.
    class RowPainter {
    public:
        explicit RowPainter(PlaneBaker& baker)
            : baker_(baker),
              line_(static_cast<std::size_t>(baker.cells_.columns + 2 * CellValues::margin)),
              slopes_(line_.size() - (cells_between - 2)),
              values_(baker.values_.size(), std::vector<float>(baker.before_.size())),
              colours_(baker.before_.size()),
              sums_(static_cast<std::size_t>(baker.maps_.colour.width)) {
            if (baker.painted_.channels > 1) {
                by_sample_.resize(colours_.size() * baker.painted_.channels);
            }
        }

        void paint(std::int64_t y) {
            std::fill(sums_.begin(), sums_.end(), Sum());
            for (std::int64_t j = y * baker_.samples_; j < (y + 1) * baker_.samples_; ++j) {
                find_values(j);
                find_colours();
                add();
            }
            const auto all = static_cast<float>(baker_.samples_ * baker_.samples_);
            Colour* const row = &baker_.maps_.colour.at(0, y);
            for (std::size_t x = 0; x < sums_.size(); ++x) {
                for (std::size_t c = 0; c < 3; ++c) row[x][c] = sums_[x].light[c] / all;
                baker_.store(static_cast<std::int64_t>(x), y, sums_[x]);
            }
            convert_to_stored({row, sums_.size()});
        }

        /// Sums over the samples of a texel. Emission and colours are in linear light.
        struct Sum {
            Colour light{};
            OfParts<float> material{};
            double height = 0;
        };

    private:
        /// The values of a row of samples.
        void find_values(std::int64_t row) {
            const SamplePlace down =
                place_of_sample(row, baker_.maps_.colour.height * baker_.samples_,
                                baker_.cells_.rows);
            for (std::size_t k = 0; k < values_.size(); ++k) {
                baker_.values_.row_at(k, down, line_);
                find_slopes(line_.data(), slopes_.data(), slopes_.size());
                // Slopes begin at the third cell of the line.
                blend_columns(&line_[2], slopes_.data(), baker_.before_.data(),
                              baker_.parts_.data(), values_[k].data(), values_[k].size());
            }
        }

        /// Computes the light of each sample of the row.
        void find_colours() {
            const PaintedCells& painted = baker_.painted_;
            const std::size_t channels = painted.channels;
            for (std::size_t k = 0; k < by_sample_.size(); ++k) {
                by_sample_[k] = values_[k % channels][k / channels];
            }
            const std::span<const float> values = channels > 1 ? by_sample_ : values_[0];
            if (painted.colours) {
                painted.colours(values, colours_);
            } else {
                for (std::size_t i = 0; i < colours_.size(); ++i) {
                    colours_[i] = shown(
                        painted.colour(values.subspan(i * channels, channels), SurfacePlace()));
                }
            }
            convert_to_light(colours_);
        }

        void add() {
            const std::size_t samples = static_cast<std::size_t>(baker_.samples_);
            for (std::size_t x = 0, i = 0; x < sums_.size(); ++x) {
                for (std::size_t n = 0; n < samples; ++n, ++i) {
                    for (std::size_t c = 0; c < 3; ++c) sums_[x].light[c] += colours_[i][c];
                }
            }
            std::size_t k = baker_.painted_.channels;
            for (const MaterialPart part : baker_.values_.parts()) {
                const bool is_light = part == MaterialPart::red || part == MaterialPart::green ||
                                      part == MaterialPart::blue;
                for (std::size_t i = 0; i < values_[k].size(); ++i) {
                    const float value = std::clamp(values_[k][i], 0.0F, 1.0F);
                    sums_[i / samples].material[part] += is_light ? light_of(value) : value;
                }
                ++k;
            }
            if (k == values_.size()) return;
            for (std::size_t i = 0; i < values_[k].size(); ++i) {
                sums_[i / samples].height += static_cast<double>(values_[k][i]);
            }
        }

        PlaneBaker& baker_;
        std::vector<float> line_, slopes_;
        std::vector<std::vector<float>> values_;  ///< The values of a row of samples.
        std::vector<float> by_sample_;  ///< The values of each sample, one sample after another.
        std::vector<Colour> colours_;
        std::vector<Sum> sums_;  ///< One for each texel of a row.
    };

    template <typename Use>
    void in_rows(Team& team, const Use& use) {
        std::vector<RowPainter> painters;  // Made here, so that threads allocate no memory.
        for (int k = 0; k < team.size(); ++k) painters.emplace_back(*this);
        std::atomic<std::int64_t> next = 0;
        team.run([&](int thread) {
            for (std::int64_t y = next++; y < maps_.colour.height; y = next++) {
                use(painters[static_cast<std::size_t>(thread)], y);
            }
        });
    }

    /// Stores all maps of a texel except for its colour.
    void store(std::int64_t x, std::int64_t y, const RowPainter::Sum& sum) {
        const auto all = static_cast<float>(samples_ * samples_);
        const auto mean = [&](MaterialPart part) { return sum.material[part] / all; };
        const auto stored = [&](float light) { return stored_of(light / all); };
        const MapSet& has = maps_.maps;
        if (has.has_surface()) {
            maps_.surface.at(x, y) = {has.occlusion ? mean(MaterialPart::occlusion) : 1,
                                      has.roughness ? mean(MaterialPart::roughness) : 1,
                                      has.metalness ? mean(MaterialPart::metalness) : 1};
        }
        if (has.emission) {
            maps_.emission.at(x, y) = {stored(sum.material[MaterialPart::red]),
                                       stored(sum.material[MaterialPart::green]),
                                       stored(sum.material[MaterialPart::blue])};
        }
        if (has.opacity) maps_.opacity.at(x, y).fill(mean(MaterialPart::opacity));
        if (has.heights) {
            maps_.relief.at(x, y)[0] =
                static_cast<float>(sum.height / static_cast<double>(samples_ * samples_));
        }
    }

    /// Computes normals from the heights of the two neighbouring texels along each axis.
    void find_normals(std::int64_t y) {
        const Image& relief = maps_.relief;
        const auto rise = [&](std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
            return static_cast<double>(relief.at(x1, y1)[0]) -
                   static_cast<double>(relief.at(x0, y0)[0]);
        };
        const auto near = [](std::int64_t k, std::int64_t count, bool repeats) {
            return std::array{FlatCells::place(k - 1, count, repeats),
                              FlatCells::place(k + 1, count, repeats)};
        };
        // At a side where the texture ends, one of the two neighbours is the texel itself.
        const auto apart = [](std::int64_t k, std::int64_t count, bool repeats, double side) {
            const bool is_at_side = !repeats && count > 1 && (k == 0 || k == count - 1);
            return is_at_side ? side : 2 * side;
        };
        const double across =
            cells_.side * static_cast<double>(cells_.columns) / static_cast<double>(relief.width);
        const double down =
            cells_.side * static_cast<double>(cells_.rows) / static_cast<double>(relief.height);
        const auto rows = near(y, relief.height, cells_.repeats[1]);
        for (std::int64_t x = 0; x < relief.width; ++x) {
            const auto columns = near(x, relief.width, cells_.repeats[0]);
            const double right = rise(columns[0], y, columns[1], y) /
                                 apart(x, relief.width, cells_.repeats[0], across);
            const double up =
                rise(x, rows[1], x, rows[0]) / apart(y, relief.height, cells_.repeats[1], down);
            const Vector3d normal = unit(Vector3d{-right, -up, 1});
            maps_.normals.at(x, y) = stored_direction(single(normal));
        }
    }

    const FlatCells& cells_;
    const PaintedCells& painted_;
    CellValues values_;
    std::int64_t samples_ = 2;  ///< Samples per texel along each axis.
    /// For each sample of a row, the index of the last cell before the sample, plus 1 because that
    /// index may be −1.
    std::vector<std::int32_t> before_;
    std::vector<float> parts_;  ///< The fraction of the way from that cell to the next one.
    MaterialMaps maps_;
};

}  // namespace

std::array<std::int64_t, 2> texture_size(const FlatCells& cells, std::int64_t texels) {
    const std::int64_t longer = std::max(cells.columns, cells.rows);
    const auto side = [&](std::int64_t count) {
        const double part = static_cast<double>(count) / static_cast<double>(longer);
        return std::max<std::int64_t>(1, std::llround(part * static_cast<double>(texels)));
    };
    return {side(cells.columns), side(cells.rows)};
}

MaterialMaps bake_plane(const FlatCells& cells, const PaintedCells& painted,
                        std::array<std::int64_t, 2> size, Team& team) {
    CHECK(painted.values.size() == cells.count() * painted.channels,
          "each cell has values of all channels");
    return PlaneBaker(cells, painted, size).run(team);
}

SurfaceMesh plane_mesh(const FlatCells& cells) {
    const double x = cells.side * static_cast<double>(cells.columns) / 2;
    const double y = cells.side * static_cast<double>(cells.rows) / 2;
    SurfaceMesh mesh;
    mesh.points = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.across.resize(2);
    mesh.across[0][2] = {1, 0};
    mesh.across[1][0] = {0, 2};
    constexpr TexturePlace low_left{0, 0}, low_right{1, 0}, high_right{1, 1}, high_left{0, 1};
    mesh.texture = {{low_left, low_right, high_right}, {low_left, high_right, high_left}};
    return mesh;
}

}  // namespace cascade
