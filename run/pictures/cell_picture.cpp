// Blurs the values of cells to a series of levels, like a mipmap. The blur of each level is twice
// as wide as the blur of the level before. A sample mixes the two levels whose blur is nearest to
// the width of surface that the sample covers.
#include "run/pictures/cell_picture.h"

#include "core/check.h"
#include "picture/srgb.h"
#include "run/pictures/refined_model.h"
#include "surface/blur_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The smallest cosine between a ray and a normal. A smaller cosine is replaced by this value.
constexpr float least_cosine = 0.1F;

/// The variance of the filter along a direction, in squares of the distance between cells. It is s²
/// / 2 times the mean of (d / s)² under the filter's weights, where s is twice the distance between
/// cells.
constexpr double filter_variance = 2 * (1.0 / 28) / 0.15;

bool is_finite(const Colour& colour) {
    return std::isfinite(colour[0]) && std::isfinite(colour[1]) && std::isfinite(colour[2]);
}

Colour light_in(const PlaceColour& function, std::span<const float> values,
                const SurfacePlace& place) {
    Colour colour = function(values, place);
    if (!is_finite(colour)) colour = colour_of_nan;
    for (float& channel : colour) channel = light_of(std::clamp(channel, 0.0F, 1.0F));
    return colour;
}

Colour mix(const Colour& a, const Colour& b, float part) {
    Colour result{};
    for (std::size_t k = 0; k < 3; ++k) result[k] = a[k] + (b[k] - a[k]) * part;
    return result;
}

/// The numbers of a cell: reflected light, and the height in units of the filter's radius. If there
/// is a material, also emitted light, roughness and metalness.
struct CellState {
    static constexpr std::size_t height = 3, glow = 4, roughness = 7, metalness = 8;
    explicit CellState(const PaintedCells& look)
        : shines(!look.material[MaterialPart::roughness].empty() ||
                 !look.material[MaterialPart::metalness].empty()),
          glows(!look.material[MaterialPart::red].empty()),
          size(shines || glows ? metalness + 1 : height + 1) {}

    bool shines, glows;
    std::size_t size;

    /// Sets the numbers of a cell's material.
    void take(const MaterialCells& material, std::size_t cell, float* state) const {
        const auto part = [&](MaterialPart each, float usual) {
            return material[each].empty() ? usual : material[each][cell];
        };
        if (size == height + 1) return;
        const Colour stored = {part(MaterialPart::red, 0), part(MaterialPart::green, 0),
                               part(MaterialPart::blue, 0)};
        const Colour light = light_of(stored);
        std::copy(light.begin(), light.end(), state + glow);
        state[roughness] = part(MaterialPart::roughness, 0.6F);
        state[metalness] = part(MaterialPart::metalness, 0);
    }
};

/// The numbers of all cells in each level. Level 0 is not blurred. Level k ≥ 1 is blurred so much
/// that blur and filter together have a standard deviation of 2^k / 2 distances between cells. A
/// sample that is 2^k distances wide has the same standard deviation.
using Levels = std::vector<std::vector<float>>;

/// Returns the level for a sample that covers a square of the surface. `side` is the side of the
/// square in distances between cells.
float level_of(float side) {
    return side > 1 ? static_cast<float>(std::log2(static_cast<double>(side))) : 0.0F;
}

/// Adds the levels that follow level 0, up to and including `highest`.
void add_levels(const SurfaceCells& cells, const CellState& parts, float highest, Levels& levels,
                Team& team) {
    // The blur need not be wider than the surface. In distances between cells, the surface is as
    // wide as the square root of the number of cells.
    const double widest = std::log2(static_cast<double>(cells.places.size())) / 2;
    const double count = std::ceil(std::min<double>(highest, widest));
    double variance = 0;
    for (int k = 1; k <= count; ++k) {
        const double wanted = std::exp2(2 * k) / 4 - filter_variance;
        levels.push_back(levels.back());
        blur_cells(cells, std::sqrt(wanted - variance), static_cast<int>(parts.size), levels.back(),
                   team);
        variance = wanted;
    }
}

/// The mesh to be drawn, which may be a refined copy of the cells' mesh.
struct Ground {
    const TriangleMesh& mesh;
    /// For each triangle of the refined mesh, the triangle of the cells' mesh that contains it.
    /// Empty if the mesh is not refined.
    std::span<const TriangleOrigin> origins;

    /// Returns the position on the cells' mesh at which a ray hits the drawn mesh.
    SurfacePlace place_of(const Hit& hit) const {
        const auto u = static_cast<double>(hit.u), v = static_cast<double>(hit.v);
        const std::array<double, 3> weights = {1 - u - v, u, v};
        return origins.empty() ? SurfacePlace{hit.triangle, weights}
                               : origins[hit.triangle].at(weights);
    }
};

class Shader {
public:
    Shader(const PaintedCells& look, const CellFilter& filter, const Ground& ground,
           const Levels& levels, float spacing)
        : look_(look),
          parts_(look),
          filter_(filter),
          ground_(ground),
          levels_(levels),
          spacing_(spacing) {}

    /// Returns the colour at a position that is seen at close range. The values are filtered before
    /// they are coloured.
    Colour light_of_cell(const SurfacePlace& place) const {
        std::vector<CellShare> shares;
        filter_.shares(place, shares);
        return own_light(shares, place);
    }

    Look operator()(const Sight& sight) const {
        const SurfacePlace place = ground_.place_of(sight.hit);
        const float level =
            std::min(level_of(side_of(sight)), static_cast<float>(levels_.size() - 1));
        Look look;
        if (look_.heights.empty() || look_.displaces) {
            std::vector<CellShare> shares;
            filter_.shares(place, shares);
            look.light = light(shares, place, level);
            take_material(shares, level, look);
            return look;
        }
        std::vector<SlopedShare> shares;
        filter_.sloped_shares(place, shares);
        look.light = light(shares, place, level);
        look.tilt = tilt(shares, level);
        take_material(shares, level, look);
        return look;
    }

private:
    /// Returns the side of the square of surface that a sample covers, in distances between cells.
    float side_of(const Sight& sight) const {
        const TriangleMesh& mesh = ground_.mesh;
        const auto& [a, b, c] = mesh.triangles[sight.hit.triangle];
        const Vector3 facet = unit(
            cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        const float cosine = std::max(least_cosine, std::abs(dot(facet, sight.direction)));
        return sight.width / spacing_ / std::sqrt(cosine);
    }

    template <typename Share>
    Colour light(const std::vector<Share>& shares, const SurfacePlace& place, float level) const {
        const auto below = static_cast<std::size_t>(level);
        const Colour sharper = below == 0 ? own_light(shares, place) : level_light(shares, below);
        const float part = level - static_cast<float>(below);
        return part > 0 ? mix(sharper, level_light(shares, below + 1), part) : sharper;
    }

    template <typename Share>
    Colour own_light(const std::vector<Share>& shares, const SurfacePlace& place) const {
        std::vector<float> values(look_.channels);
        for (const Share& share : shares) {
            const float* of_cell = &look_.values[share.cell * look_.channels];
            for (std::size_t k = 0; k < values.size(); ++k) values[k] += share.weight * of_cell[k];
        }
        return light_in(look_.colour, values, place);
    }

    template <typename Share>
    void take_material(const std::vector<Share>& shares, float level, Look& look) const {
        if (parts_.glows) {
            for (std::size_t k = 0; k < 3; ++k) {
                look.glow[k] = state_at(shares, level, CellState::glow + k);
            }
        }
        if (parts_.shines) {
            look.gloss = gloss_of(state_at(shares, level, CellState::roughness),
                                  state_at(shares, level, CellState::metalness));
        }
    }

    /// Returns one of the cells' numbers at a position, mixed from two levels.
    template <typename Share>
    float state_at(const std::vector<Share>& shares, float level, std::size_t number) const {
        const auto below = static_cast<std::size_t>(level);
        const auto in_level = [&](std::size_t k) {
            float sum = 0;
            for (const Share& share : shares) {
                sum += share.weight * levels_[k][share.cell * parts_.size + number];
            }
            return sum;
        };
        const float part = level - static_cast<float>(below);
        const float sharper = in_level(below);
        return part > 0 ? sharper + (in_level(below + 1) - sharper) * part : sharper;
    }

    template <typename Share>
    Colour level_light(const std::vector<Share>& shares, std::size_t level) const {
        Colour sum{0, 0, 0};
        for (const Share& share : shares) {
            const float* state = &levels_[level][share.cell * parts_.size];
            for (std::size_t k = 0; k < 3; ++k) sum[k] += share.weight * state[k];
        }
        return sum;
    }

    Vector3 tilt(const std::vector<SlopedShare>& shares, float level) const {
        const auto below = static_cast<std::size_t>(level);
        const float part = level - static_cast<float>(below);
        Vector3 slope = slope_at(shares, below);
        if (part > 0) slope = slope * (1 - part) + slope_at(shares, below + 1) * part;
        return std::isfinite(dot(slope, slope)) ? -slope : Vector3{};
    }

    Vector3 slope_at(const std::vector<SlopedShare>& shares, std::size_t level) const {
        Vector3 slope;
        for (const SlopedShare& share : shares) {
            slope =
                slope + share.slope * levels_[level][share.cell * parts_.size + CellState::height];
        }
        return slope;
    }

    const PaintedCells& look_;
    CellState parts_;
    const CellFilter& filter_;
    const Ground& ground_;
    const Levels& levels_;
    float spacing_;
};

/// Computes the opacity where a ray hits the surface. The opacity depends only on the cells next to
/// that point, even if the camera is far away. So holes have edges as sharp as in GLB files.
class Opacity {
public:
    Opacity(std::span<const float> of_cells, const CellFilter& filter, const Ground& ground)
        : of_cells_(of_cells), filter_(filter), ground_(ground), is_cut_(is_cut(of_cells)) {}

    float operator()(const Hit& hit) const {
        std::vector<CellShare> shares;
        filter_.shares(ground_.place_of(hit), shares);
        float sum = 0;
        for (const CellShare& share : shares) sum += share.weight * of_cells_[share.cell];
        if (is_cut_) return sum < 0.5F ? 0 : 1;
        // A sum that is smaller than this counts as 0, because rounding errors make the sum of
        // weights differ from 1.
        constexpr float little = 1e-3F;
        return sum < little ? 0 : sum > 1 - little ? 1 : sum;
    }

private:
    std::span<const float> of_cells_;
    const CellFilter& filter_;
    const Ground& ground_;
    bool is_cut_;
};

/// Returns the width of the largest square of surface that a sample of the picture covers, in
/// lengths of the mesh.
float widest_side(const TriangleMesh& mesh, const DrawOptions& options) {
    const Camera camera(mesh, options.view, options.width, options.height);
    float farthest = 0;
    for (const Vector3& p : mesh.positions) farthest = std::max(farthest, length(p - camera.eye()));
    return camera.pixel() * farthest * effort_of(options.quality).widest_ray() /
           std::sqrt(least_cosine);
}

}  // namespace

/// The surface that heights have moved. It is drawn in place of the original surface.
struct CellScene::Raised {
    std::vector<float> heights;
    RefinedMesh fine;
    TriangleMesh drawn;
    RayCaster caster;

    Raised(std::span<const float> by, RefinedMesh raised, const DrawnMesh& at)
        : heights(by.begin(), by.end()),
          fine(std::move(raised)),
          drawn(creased_mesh(fine.mesh, at.middle, at.scale)),
          caster(drawn) {}
};

CellScene::CellScene(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team)
    : mesh_(mesh),
      cells_(cells),
      drawn_(creased_mesh(mesh)),
      caster_(drawn_.mesh),
      filter_(mesh, cells, team) {
    spacing_ = static_cast<float>(cell_spacing(cells) * drawn_.scale);
}

CellScene::~CellScene() = default;

const CellScene::Raised& CellScene::raise(std::span<const float> heights, Team& team) {
    if (!raised_ || !std::ranges::equal(raised_->heights, heights)) {
        raised_.reset();
        raised_ = std::make_unique<const Raised>(heights,
                                                 raised_model(refined_for_colours(mesh_, cells_),
                                                              mesh_, filter_, heights, team),
                                                 drawn_);
    }
    return *raised_;
}

Image CellScene::draw(const PaintedCells& look, DrawOptions options, Team& team,
                      const Instances* copies) {
    const std::size_t count = cells_.places.size();
    CHECK(look.values.size() == count * look.channels, "each cell has values of all channels");
    CHECK(look.heights.empty() || look.heights.size() == count, "each cell has a height");
    options.round_shadows = true;
    const bool is_raised = look.displaces && !look.heights.empty();
    const Raised* const raised = is_raised ? &raise(look.heights, team) : nullptr;
    const Ground ground{raised ? raised->drawn : drawn_.mesh,
                        raised ? std::span<const TriangleOrigin>(raised->fine.origins)
                               : std::span<const TriangleOrigin>()};
    const auto opacities = look.material[MaterialPart::opacity];
    if (std::any_of(opacities.begin(), opacities.end(), [](float each) { return each < 1; })) {
        options.opacity = Opacity(opacities, filter_, ground);
    }
    const float highest = level_of(widest_side(ground.mesh, options) / spacing_);
    Levels levels(1);
    const Shader shader(look, filter_, ground, levels, spacing_);
    const CellState parts(look);
    if (highest > 0 || !look.heights.empty() || parts.shines || parts.glows) {
        std::vector<float>& states = levels[0];
        states.resize(count * parts.size);
        team.run([&](int thread) {
            const RowRange part = split_rows(static_cast<std::int64_t>(count), thread, team.size());
            for (auto cell = static_cast<std::size_t>(part.begin);
                 cell < static_cast<std::size_t>(part.end); ++cell) {
                float* state = &states[cell * parts.size];
                parts.take(look.material, cell, state);
                if (highest > 0) {
                    const Colour light = shader.light_of_cell(cells_.places[cell]);
                    std::copy(light.begin(), light.end(), state);
                }
                if (look.heights.empty()) continue;
                state[CellState::height] =
                    static_cast<float>(static_cast<double>(look.heights[cell]) / filter_.radius());
            }
        });
    }
    add_levels(cells_, parts, highest, levels, team);
    if (copies == nullptr) {
        return cascade::draw(raised ? raised->caster : caster_, shader, options, team);
    }
    const cascade::Scene all(&ground.mesh, copies);
    return cascade::draw(RayCaster(all), shader, options, team);
}

}  // namespace cascade
