// Threads paint bands of rows of texels. Each texel is the mean of its samples in linear light.
// Afterwards, gaps are filled and colours are converted to sRGB.
#include "export/bake.h"

#include "core/check.h"
#include "core/counted.h"
#include "core/enough_memory.h"
#include "export/field_samples.h"
#include "export/fill_gaps.h"
#include "export/map_texels.h"
#include "export/render_vertices.h"
#include "mesh/normals.h"
#include "mesh/triangle_mesh.h"
#include "picture/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace cascade {

namespace {

constexpr std::int64_t rows_of_band = 16;  ///< Rows of texels that a thread paints at a time.
/// The largest area that texture coordinates may cover, as a multiple of the texture's area. If
/// they cover more, the texture is meant to repeat all over the model.
constexpr double most_covered_area = 64;

tl::unexpected<Failure> no_area() {
    return failure("the model's texture coordinates have no area in the texture",
                   "use --unwrap to make new ones");
}

/// Working memory of one thread, allocated in advance.
struct Scratch {
    std::unique_ptr<SamplePainter> painter;
    std::vector<std::uint32_t> owners = {};     ///< The triangle of each sample in a band.
    std::span<const std::uint32_t> row = {};    ///< The part of `owners` for one row of texels.
    std::vector<Colour> lights = {};            ///< One per sample of a row of texels.
    std::vector<float> heights = {};            ///< One per sample of a row of texels.
    std::vector<OfParts<float>> material = {};  ///< One per sample of a row of texels.
    std::vector<SurfacePlace> places = {};  ///< One per sample of a texel, if there are heights.
    std::int64_t covered = 0;               ///< Number of samples on the surface.
    TextureLayout::Overlap overlap = {};
};

class TextureBaker {
public:
    TextureBaker(const SurfaceMesh& mesh, const MakeSamplePainter& make_painter,
                 const BakeOptions& options)
        : mesh_(mesh),
          make_painter_(make_painter),
          maps_(make_painter()->maps()),
          options_(options),
          layout_(mesh, options.width * options.samples, options.height * options.samples),
          normals_(corner_normals(mesh)),
          vertices_(render_vertices(mesh, normals_)),
          colour_(options.width, options.height),
          relief_(texture_if(maps_.heights)),
          slopes_(texture_if(maps_.normals)),
          material_{texture_if(maps_.has_surface()), texture_if(maps_.emission),
                    texture_if(maps_.opacity)} {}

    Result<Bake> run(Team& team, const std::atomic<bool>& cancel) {
        std::vector<Scratch> scratch;
        for (int k = 0; k < team.size(); ++k) scratch.push_back(make_scratch());
        const std::int64_t bands = (options_.height + rows_of_band - 1) / rows_of_band;
        std::atomic<std::int64_t> next = 0;
        team.run([&](int index) {
            Scratch& own = scratch[static_cast<std::size_t>(index)];
            for (std::int64_t band = next++; band < bands && !cancel; band = next++) {
                paint_band(band * rows_of_band,
                           std::min((band + 1) * rows_of_band, options_.height), own);
            }
        });
        std::int64_t covered = 0;
        TextureLayout::Overlap overlap;
        for (const Scratch& own : scratch) {
            covered += own.covered;
            overlap.again += own.overlap.again;
            overlap.shared += own.overlap.shared;
        }
        if (covered == 0 && !cancel) {
            return no_area();
        }
        return finish(covered, overlap);
    }

private:
    PartialTexture texture_if(bool is_there) const {
        return is_there ? PartialTexture(options_.width, options_.height) : PartialTexture();
    }
    std::int64_t samples() const { return options_.samples; }
    std::size_t texel(std::int64_t x, std::int64_t y) const {
        return static_cast<std::size_t>(y * options_.width + x);
    }

    Scratch make_scratch() const {
        Scratch own{make_painter_()};
        const auto row = static_cast<std::size_t>(layout_.width() * samples());
        own.owners.resize(row * static_cast<std::size_t>(rows_of_band));
        own.lights.resize(row);
        own.heights.resize(row);
        own.material.resize(row);
        own.places.reserve(static_cast<std::size_t>(samples() * samples()));
        return own;
    }

    void paint_band(std::int64_t first, std::int64_t last, Scratch& own) {
        const auto count = static_cast<std::size_t>((last - first) * samples() * layout_.width());
        const std::span<std::uint32_t> owners(own.owners.data(), count);
        const auto overlap = layout_.find_owners(first * samples(), last * samples(), owners);
        own.overlap.again += overlap.again;
        own.overlap.shared += overlap.shared;
        const auto width = static_cast<std::size_t>(layout_.width());
        for (std::int64_t y = first; y < last; ++y) {
            own.row = owners.subspan(static_cast<std::size_t>((y - first) * samples()) * width,
                                     static_cast<std::size_t>(samples()) * width);
            for (std::int64_t j = 0; j < samples(); ++j) paint_samples(y, j, own);
            for (std::int64_t x = 0; x < options_.width; ++x) paint_texel(x, y, own);
        }
    }

    /// The index of sample (i, j) in the row of texels that a thread paints.
    std::size_t sample(std::int64_t i, std::int64_t j) const {
        return static_cast<std::size_t>(j * layout_.width() + i);
    }

    /// Paints the samples of a row in spans. A span is a sequence of samples in one triangle.
    void paint_samples(std::int64_t y, std::int64_t j, Scratch& own) const {
        for (std::int64_t i = 0; i < layout_.width();) {
            const std::uint32_t owner = own.row[sample(i, j)];
            const std::int64_t first = i;
            do ++i;
            while (i < layout_.width() && own.row[sample(i, j)] == owner);
            if (owner != TextureLayout::nothing) paint_span(owner, first, i, y, j, own);
        }
    }

    void paint_span(std::uint32_t owner, std::int64_t first, std::int64_t end, std::int64_t y,
                    std::int64_t j, Scratch& own) const {
        const std::size_t begin = sample(first, j), count = sample(end, j) - begin;
        own.painter->paint({layout_, owner, first, y * samples() + j,
                            std::span(own.lights).subspan(begin, count),
                            std::span(own.heights).subspan(begin, count),
                            std::span(own.material).subspan(begin, count)});
        own.covered += end - first;
    }

    /// Calls `visit(i, j)` for each sample of a texel that is on the surface.
    template <typename Visit>
    void visit_samples(std::int64_t x, const Scratch& own, const Visit& visit) const {
        for (std::int64_t j = 0; j < samples(); ++j) {
            for (std::int64_t i = x * samples(); i < (x + 1) * samples(); ++i) {
                if (own.row[sample(i, j)] != TextureLayout::nothing) visit(i, j);
            }
        }
    }

    void paint_texel(std::int64_t x, std::int64_t y, Scratch& own) {
        Colour sum{};
        OfParts<float> material{};
        int count = 0;
        visit_samples(x, own, [&](std::int64_t i, std::int64_t j) {
            for (std::size_t c = 0; c < 3; ++c) sum[c] += own.lights[sample(i, j)][c];
            for (std::size_t k = 0; k < material_parts; ++k) {
                material[k] += own.material[sample(i, j)][k];
            }
            ++count;
        });
        if (count == 0) return;
        for (float& light : sum) light /= static_cast<float>(count);
        colour_.texels[texel(x, y)] = sum;
        colour_.is_filled[texel(x, y)] = 1;
        for (std::size_t k = 0; k < material_parts; ++k) {
            PartialTexture& texture = material_[k / 3];
            if (texture.texels.empty()) continue;
            texture.texels[texel(x, y)][k % 3] = material[k] / static_cast<float>(count);
            texture.is_filled[texel(x, y)] = 1;
        }
        if (maps_.heights && !lift_texel(x, y, own)) return;
        if (maps_.normals) turn_texel(x, y, own);
    }

    /// Computes the mean height of a texel's samples. Returns false if no height is finite.
    bool lift_texel(std::int64_t x, std::int64_t y, const Scratch& own) {
        double sum = 0, finite = 0;
        visit_samples(x, own, [&](std::int64_t i, std::int64_t j) {
            const float height = own.heights[sample(i, j)];
            if (!std::isfinite(height)) return;
            sum += static_cast<double>(height);
            ++finite;
        });
        if (finite == 0) return false;
        relief_.texels[texel(x, y)][0] = static_cast<float>(sum / finite);
        relief_.is_filled[texel(x, y)] = 1;
        return true;
    }

    void turn_texel(std::int64_t x, std::int64_t y, Scratch& own) {
        own.places.clear();
        visit_samples(x, own, [&](std::int64_t i, std::int64_t j) {
            own.places.push_back(layout_.place_at(own.row[sample(i, j)], i, y * samples() + j));
        });
        const Vector3 normal = raised_normal(own);
        if (!std::isfinite(normal.x + normal.y + normal.z)) return;
        slopes_.texels[texel(x, y)] = {normal.x, normal.y, normal.z};
        slopes_.is_filled[texel(x, y)] = 1;
    }

    /// The mean normal of the raised surface at a texel's samples, in components along the tangent,
    /// the bitangent and the smooth normal.
    Vector3 raised_normal(Scratch& own) const {
        const SurfacePlace& place = own.places[own.places.size() / 2];
        const Vector3d normal = normals_.at(mesh_, place);
        Vector3d sum;
        for (std::size_t k = 0; k < 3; ++k) {
            sum = sum + vertices_.tangents[vertices_.triangles[place.triangle][k]].direction *
                            place.weights[k];
        }
        const Vector3d tangent = unit(sum - normal * dot(sum, normal));
        const int side = vertices_.tangents[vertices_.triangles[place.triangle][0]].side;
        const Vector3d bitangent = cross(normal, tangent) * static_cast<double>(side);
        const Vector3d raised = own.painter->raised_normal(own.places, normal);
        const Vector3d bumped =
            unit(Vector3d{dot(raised, tangent), dot(raised, bitangent), dot(raised, normal)});
        return single(bumped);
    }

    Bake finish(std::int64_t covered, const TextureLayout::Overlap& overlap) {
        Bake bake;
        const auto all = static_cast<double>(layout_.width() * layout_.height());
        bake.covered = static_cast<double>(covered) / all;
        bake.overlapping = static_cast<double>(overlap.again) /
                           static_cast<double>(std::max(covered + overlap.again, std::int64_t{1}));
        bake.shared = static_cast<double>(overlap.shared) / all;
        warn(bake);
        fill_gaps(colour_);
        for (Colour& texel : colour_.texels) texel = stored_of(texel);
        bake.colour = image_of(std::move(colour_));
        bake.maps = maps_;
        finish_material(bake);
        if (maps_.heights) finish_relief(bake);
        if (!maps_.normals) return bake;
        fill_gaps(slopes_);
        for (auto& texel : slopes_.texels) {
            Vector3 normal = unit(Vector3{texel[0], texel[1], texel[2]});
            if (length(normal) == 0) normal = {0, 0, 1};
            texel = stored_direction(normal);
        }
        bake.normals = image_of(std::move(slopes_));
        return bake;
    }

    void finish_material(Bake& bake) {
        auto& [surface, emission, opacity] = material_;
        for (PartialTexture& texture : material_) fill_gaps(texture);
        const std::array<bool, 3> has = {maps_.occlusion, maps_.roughness, maps_.metalness};
        for (auto& texel : surface.texels) {
            for (std::size_t c = 0; c < 3; ++c) texel[c] = has[c] ? texel[c] : 1;
        }
        for (auto& texel : emission.texels) texel = stored_of(texel);
        for (auto& texel : opacity.texels) texel.fill(texel[0]);
        bake.surface = image_of(std::move(surface));
        bake.emission = image_of(std::move(emission));
        bake.opacity = image_of(std::move(opacity));
    }

    void finish_relief(Bake& bake) {
        bool has_height = false;
        for (std::size_t k = 0; k < relief_.texels.size(); ++k) {
            if (relief_.is_filled[k] == 0) continue;
            const float height = relief_.texels[k][0];
            bake.heights.low = has_height ? std::min(bake.heights.low, height) : height;
            bake.heights.high = has_height ? std::max(bake.heights.high, height) : height;
            has_height = true;
        }
        if (!has_height) bake.heights = {0, 0};
        fill_gaps(relief_);
        store_heights(bake.heights, relief_.texels);
        bake.relief = image_of(std::move(relief_));
    }

    static Image image_of(PartialTexture texture) {
        Image image;
        image.width = texture.width;
        image.height = texture.height;
        image.pixels = std::move(texture.texels);
        return image;
    }

    void warn(Bake& bake) const {
        if (bake.overlapping >= 5e-4) {
            const double mirrored = layout_.mirrored_part();
            const std::string_view why =
                layout_.repeats() ? ", over which the picture repeats"
                : mirrored > 0.1 && mirrored < 0.9
                    ? ", one of them mirrored, as the two halves of a body may be"
                    : "";
            bake.warnings.push_back(fmt::format(
                "{:.1f} % of the texture belongs to several parts of the model{}: {:.1f} % of the "
                "model shows the pattern of another part; --unwrap gives each part another place "
                "in the texture",
                100 * bake.shared, why, 100 * bake.overlapping));
        }
        if (layout_.skipped().without_area > 0) {
            bake.warnings.push_back(counted(layout_.skipped().without_area, "triangle") +
                                    " without area in the texture left out");
        }
        if (layout_.skipped().without_place > 0) {
            bake.warnings.push_back(fmt::format(
                "{} with texture coordinates that are not finite or beyond ±{} left out",
                counted(layout_.skipped().without_place, "triangle"),
                TextureLayout::largest_place));
        }
    }

    const SurfaceMesh& mesh_;
    const MakeSamplePainter& make_painter_;
    MapSet maps_;
    const BakeOptions& options_;
    TextureLayout layout_;
    CornerNormals normals_;
    RenderVertices vertices_;
    PartialTexture colour_, relief_, slopes_;
    std::array<PartialTexture, 3> material_;  ///< Parts of the material, three in each texture.
};

}  // namespace

Result<void> check_bakeable(const SurfaceMesh& mesh, double samples) {
    if (mesh.texture.empty()) {
        return failure("the model has no texture coordinates to paint by",
                       "use --unwrap to make some");
    }
    const double covered = TextureLayout(mesh, 1, 1).covered_area();
    if (covered * samples < 1) return no_area();
    if (covered <= most_covered_area) return {};
    return failure(
        fmt::format("the model's texture coordinates cover the texture {:.0f} times over", covered),
        "they are meant for a picture that repeats; --unwrap gives every part of the model "
        "another place");
}

Result<Bake> bake(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel) {
    const auto painter = [&] { return std::make_unique<FieldSamples>(mesh, filter, cells); };
    auto baked = bake(mesh, painter, options, team, cancel);
    if (baked) baked->is_cut = is_cut(cells.material[MaterialPart::opacity]);
    return baked;
}

Result<Bake> bake(const SurfaceMesh& mesh, const MakeSamplePainter& painter,
                  const BakeOptions& options, Team& team, const std::atomic<bool>& cancel) {
    const auto is_side = [](std::int64_t side) {
        return side >= 1 && side <= BakeOptions::largest_texture;
    };
    CHECK(is_side(options.width) && is_side(options.height) && options.samples >= 1 &&
              options.samples <= 8,
          "the size of a texture is checked where it is given");
    const double samples =
        static_cast<double>(options.width * options.height) * (options.samples * options.samples);
    if (auto good = check_bakeable(mesh, samples); !good) return tl::unexpected(good.error());
    return enough_memory_for(
        [&]() -> Result<Bake> { return TextureBaker(mesh, painter, options).run(team, cancel); },
        fmt::format("there is not enough memory for a texture of {} × {}", options.width,
                    options.height));
}

}  // namespace cascade
