// Traces few rays where the picture is uniform, and more rays elsewhere.
//
// Every pixel begins with one ray through its middle, which tests the sun and the sky once. The
// tests of 5 × 5 pixels together are evenly spread over a light, so a window of tests shows how
// much of the light is hidden.
// - If adjacent pixels show different things, there is an edge. The pixel sends at least four rays,
// each of which tests both lights, until their mean is accurate enough.
// - If only the colours differ, the pixel sends rays in the same way, but its rays share the
// results of its tests of lights.
// - If a light is partly hidden around a pixel, the light is tested more often.
// - The visible part of a light varies slowly along a surface. Pixels use the mean over their
// neighbours on the same piece of the surface. For the sun, which casts outlines, they use only the
// nearest neighbours.
// - If a surface is translucent, a pixel is treated as an edge, and each ray continues through the
// surface.
// - If there are copies and edges all around, as in fur, no outline stands out. A pixel sends only
// four rays, and also uses the visible parts of the lights at the pixels around it.
#include "render/tile_drawer.h"

#include "picture/srgb.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cascade {

namespace {

/// The side of a square of pixels. Each pixel of the square tests a different part of a light.
constexpr int turn_side = 5;
/// The largest distance, in pixels, over which a pixel uses the tests of the sun and of the sky at
/// other pixels.
constexpr int sun_reach = 1, sky_reach = 2;
/// The number of tests that a partly hidden light gets.
constexpr std::uint32_t enough_tests = 16;
/// Two hits are on different pieces of a surface if the cosine between their normals is smaller.
constexpr float least_cosine = 0.9F;
/// If the visible part of the sun differs by more than this between a pixel and its neighbours, the
/// outline of a shadow is between them.
constexpr float sharp_outline = 0.2F;
/// If the contrast to an adjacent pixel is above this, one ray is not enough.
constexpr float contrast_beside = 0.06F;
/// If the visible part of the sky is below this, a pixel is in a crevice.
constexpr float dark_share = 0.2F;

float contrast(const Colour& a, const Colour& b) {
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

}  // namespace

TileDrawer::TileDrawer(const Tracer& tracer, const DrawOptions& options)
    : tracer_(tracer), options_(options), effort_(effort_of(options.quality)) {}

void TileDrawer::draw(std::int64_t left, std::int64_t top, Image& image) {
    left_ = left - margin;
    top_ = top - margin;
    room_.assign(static_cast<std::size_t>(room_side * room_side), Pixel());
    visit(margin, [&](Pixel& pixel) { look(pixel); });
    visit(sky_reach, [&](Pixel& pixel) {
        look_beside(pixel);
        ask_more(Light::sky, pixel);
    });
    visit(sun_reach, [&](Pixel& pixel) { ask_more(Light::sun, pixel); });
    visit(0, [&](Pixel& pixel) {
        put(light_of_pixel(pixel), options_.background.has_value(), left_ + pixel.x, top_ + pixel.y,
            image);
    });
}

/// Visits the pixels of the tile and of a border of `around` pixels, except pixels outside of the
/// picture.
template <typename Use>
void TileDrawer::visit(std::int64_t around, const Use& use) {
    const std::int64_t first = margin - around, last = margin + side + around;
    for (std::int64_t y = std::max(first, -top_); y < std::min(last, options_.height - top_); ++y) {
        for (std::int64_t x = std::max(first, -left_); x < std::min(last, options_.width - left_);
             ++x) {
            Pixel& pixel = room_[static_cast<std::size_t>(y * room_side + x)];
            pixel.x = static_cast<std::int16_t>(x);
            pixel.y = static_cast<std::int16_t>(y);
            use(pixel);
        }
    }
}

/// Visits the pixels of a square around a pixel, including the pixel itself, if they are in the
/// picture and have been traced.
template <typename Use>
void TileDrawer::visit_around(const Pixel& pixel, int reach, const Use& use) {
    const auto low = [](std::int64_t at, std::int64_t start) {
        return std::max({at, -start, std::int64_t{0}});
    };
    const auto high = [](std::int64_t at, std::int64_t start, std::int64_t length) {
        return std::min({at, length - start - 1, room_side - 1});
    };
    const std::int64_t right = high(pixel.x + reach, left_, options_.width);
    const std::int64_t bottom = high(pixel.y + reach, top_, options_.height);
    for (std::int64_t y = low(pixel.y - reach, top_); y <= bottom; ++y) {
        for (std::int64_t x = low(pixel.x - reach, left_); x <= right; ++x) {
            use(room_[static_cast<std::size_t>(y * room_side + x)]);
        }
    }
}

template <typename Use>
void TileDrawer::visit_sides(const Pixel& pixel, const Use& use) const {
    const std::size_t at = static_cast<std::size_t>(pixel.y * room_side + pixel.x);
    if (left_ + pixel.x > 0) use(room_[at - 1]);
    if (left_ + pixel.x + 1 < options_.width) use(room_[at + 1]);
    if (top_ + pixel.y > 0) use(room_[at - room_side]);
    if (top_ + pixel.y + 1 < options_.height) use(room_[at + room_side]);
}

/// Traces a ray. The ray samples an area `width` pixels wide.
Seen TileDrawer::trace(const Pixel& pixel, Point place, float width) const {
    return tracer_.trace(static_cast<float>(left_ + pixel.x) + place.x,
                         static_cast<float>(top_ + pixel.y) + place.y, width);
}

TileDrawer::Tally TileDrawer::ask(Light light, const Seen& from, Point place) const {
    const DiscPoint disc = on_disc(place);
    const bool sees =
        light == Light::sun ? tracer_.sees_sun(from, disc) : tracer_.sees_sky(from, disc);
    return {1, sees ? std::uint16_t{1} : std::uint16_t{0}};
}

/// Tests whether a light is visible. Adjacent pixels test different parts of the light, and each
/// pixel tests a different part in each round.
TileDrawer::Tally TileDrawer::ask_in_turn(Light light, const Pixel& pixel,
                                          std::uint32_t round) const {
    constexpr std::int64_t above_margin = turn_side;
    const auto column = static_cast<std::uint32_t>((left_ + pixel.x + above_margin) % turn_side);
    const auto row = static_cast<std::uint32_t>((top_ + pixel.y + above_margin) % turn_side);
    const std::uint32_t number = (round * turn_side + row) * turn_side + column;
    return ask(light, pixel.seen, even_point(number, 0, 0));
}

/// Whether two hits, in one pixel or in adjacent pixels, are on one piece of a surface.
bool TileDrawer::is_one_piece(const Seen& a, const Seen& b) const {
    if (a.kind != b.kind) return false;
    if (a.kind != Seen::Kind::surface) return true;
    const float near = 3 * tracer_.pixel_at(a.place);
    return dot(a.normal, b.normal) >= least_cosine &&
           std::abs(dot(a.normal, b.place - a.place)) <= near;
}

void TileDrawer::look(Pixel& pixel) {
    pixel.seen = trace(pixel, {0.5F, 0.5F}, effort_.widest_ray());
    pixel.tone = tone_of(light_of(pixel.seen, 1, 1));
    if (pixel.seen.kind == Seen::Kind::background) return;
    for (const Light light : {Light::sun, Light::sky}) {
        pixel.first[light] = ask_in_turn(light, pixel, 0);
    }
}

/// Compares a pixel with the pixels at its four sides. If an edge crosses the pixel, the edge is
/// between the pixel's middle and the middle of one of these pixels.
void TileDrawer::look_beside(Pixel& pixel) {
    const auto is_lit_alike = [&](const Pixel& other) {
        return other.first.sun.seen == pixel.first.sun.seen &&
               other.first.sky.seen == pixel.first.sky.seen;
    };
    if (pixel.seen.is_translucent) pixel.is_edge = true;
    visit_sides(pixel, [&](const Pixel& other) {
        if (pixel.seen.kind != other.seen.kind) {
            pixel.is_edge = true;
            return;
        }
        const bool differs = contrast(other.tone, pixel.tone) > contrast_beside;
        if (!differs && is_lit_alike(other)) return;
        if (!is_one_piece(pixel.seen, other.seen)) pixel.is_edge = true;
        else if (differs) pixel.is_varied = true;
    });
}

void TileDrawer::ask_more(Light light, Pixel& pixel) {
    pixel.all[light] = pixel.first[light];
    if (pixel.seen.kind == Seen::Kind::background) return;
    Tally around;
    visit_around(pixel, turn_side / 2, [&](const Pixel& other) { around += other.first[light]; });
    pixel.is_partly_hidden[light] = around.is_partial();
    // Copies cast outlines on each other. But the visible part of the sky is small and varied on
    // copies anyway, so it needs no more tests.
    if (pixel.seen.is_copy && light == Light::sky) return;
    // In a crevice hardly any sky is visible, and noise stands out most in the dark.
    const bool is_dark = light == Light::sky && around.share() < dark_share;
    if (!around.is_partial() && !is_dark) return;
    const std::uint32_t tests =
        light == Light::sun ? effort_.sun_tests : (is_dark ? 4 : 1) * effort_.sky_tests;
    for (std::uint32_t round = 1; round < tests; ++round) {
        pixel.all[light] += ask_in_turn(light, pixel, round);
    }
}

PixelLight TileDrawer::light_of_pixel(Pixel& pixel) {
    const bool is_uniform = !pixel.is_edge && !pixel.is_varied;
    const bool one_is_enough = is_uniform && effort_.one_is_enough;
    if (one_is_enough && pixel.seen.kind == Seen::Kind::background) {
        return light_of_ray(pixel.seen, 0, 0);
    }
    const auto shares_around = [&] {
        return OfLights<float>{share_around(Light::sun, pixel, sun_reach),
                               share_around(Light::sky, pixel, sky_reach)};
    };
    OfLights<float> shares;
    if (!pixel.is_edge) {
        shares = shares_around();
        if (one_is_enough && !is_at_outline_of_shadow(pixel, shares.sun)) {
            return light_of_ray(pixel.seen, shares.sun, shares.sky);
        }
    }
    const Rays rays = first_rays_of(pixel);
    if (effort_.one_is_enough && is_in_thicket(pixel, rays)) return light_in_thicket(pixel, rays);
    const bool is_torn =
        pixel.is_edge && !std::all_of(rays.begin(), rays.end(), [&](const Seen& each) {
            return !each.is_translucent && is_one_piece(pixel.seen, each);
        });
    if (pixel.is_edge && !is_torn) shares = shares_around();
    const bool is_at_outline = !is_torn && is_at_outline_of_shadow(pixel, shares.sun);
    const Shifts shift = shifts(pixel);
    const auto& [u, v, w, t] = shift.of_lights;
    const auto shares_of = [&](const Seen& from, std::uint32_t k) -> OfLights<float> {
        if (from.kind == Seen::Kind::background) return {};
        OfLights<float> own = shares;
        if (is_torn || is_at_outline) own.sun = ask(Light::sun, from, even_point(k, u, v)).share();
        if (is_torn) own.sky = ask(Light::sky, from, even_point(k, w, t)).share();
        return own;
    };
    // At an edge, more than four rays are needed, because four rays that agree may all have missed
    // the edge.
    const std::uint32_t least = is_torn      ? 4 * first_rays
                                : is_uniform ? first_rays
                                             : std::max(first_rays, effort_.most_rays / 4);
    return light_of_rays(pixel, rays, least, shares_of);
}

/// Whether the pixel's own tests agree with each other, but not with the tests of its neighbours.
/// In a gradual transition to shadow, the pixel's own tests disagree.
bool TileDrawer::is_at_outline_of_shadow(const Pixel& pixel, float share) const {
    if (pixel.seen.kind == Seen::Kind::background || pixel.all.sun.is_partial()) return false;
    return std::abs(pixel.all.sun.share() - share) > sharp_outline;
}

TileDrawer::Rays TileDrawer::first_rays_of(const Pixel& pixel) const {
    Rays rays;
    for (std::uint32_t k = 0; k < first_rays; ++k) rays[k] = trace(pixel, first_point(k), 0.5F);
    return rays;
}

/// The visible part of a light at a pixel, using the tests of pixels around it.
float TileDrawer::share_around(Light light, Pixel& pixel, int reach) {
    if (pixel.seen.kind == Seen::Kind::background) return 1;
    Tally sum;
    if (!pixel.is_partly_hidden[light]) {
        // If all tests at the surrounding pixels agree, all of them can be used.
        visit_around(pixel, reach, [&](const Pixel& other) { sum += other.all[light]; });
        if (!sum.is_partial()) return sum.share();
        sum = {};
    }
    visit_around(pixel, reach, [&](const Pixel& other) {
        if (&other != &pixel && !is_one_piece(pixel.seen, other.seen)) return;
        sum += other.all[light];
    });
    if (!pixel.is_partly_hidden[light]) return sum.share();
    // On a narrow piece of surface, few neighbours count, so more tests are made for this pixel.
    Tally& own = pixel.all[light];
    while (sum.asked < enough_tests) {
        const Tally answer = ask_in_turn(light, pixel, own.asked);
        own += answer;
        sum += answer;
    }
    return sum.share();
}

/// Whether this pixel shows only copies, and at least half of the pixels around have edges.
bool TileDrawer::is_in_thicket(const Pixel& pixel, const Rays& rays) {
    if (!std::all_of(rays.begin(), rays.end(), [](const Seen& seen) { return seen.is_copy; })) {
        return false;
    }
    int count = 0, edges = 0;
    visit_around(pixel, 2, [&](const Pixel& other) {
        ++count;
        if (other.is_edge) ++edges;
    });
    return 2 * edges >= count;
}

/// The light of four rays, with the visible parts of the lights at this pixel and around it.
PixelLight TileDrawer::light_in_thicket(const Pixel& pixel, const Rays& rays) {
    OfLights<Tally> tally;
    for (const Light light : {Light::sun, Light::sky}) {
        visit_around(pixel, light == Light::sun ? sun_reach : sky_reach, [&](const Pixel& other) {
            if (other.seen.is_copy) tally[light] += other.first[light];
        });
    }
    const Shifts shift = shifts(pixel);
    const auto& [u, v, w, t] = shift.of_lights;
    for (std::uint32_t k = 0; k < first_rays; ++k) {
        if (k % 2 == 0) tally.sun += ask(Light::sun, rays[k], even_point(k, u, v));
        else tally.sky += ask(Light::sky, rays[k], even_point(k, w, t));
    }
    MeanLight mean;
    for (const Seen& seen : rays) {
        mean.add(light_of_ray(seen, tally.sun.share(), tally.sky.share()));
    }
    return mean.light();
}

/// The mean light of several rays through a pixel. `shares(seen, number)` gives the visible parts
/// of the lights for the hit of ray `number`.
template <typename Shares>
PixelLight TileDrawer::light_of_rays(const Pixel& pixel, const Rays& first, std::uint32_t least,
                                     const Shares& shares) {
    const Shifts shift = shifts(pixel);
    const float width = 1 / std::sqrt(static_cast<float>(effort_.most_rays));
    MeanLight mean;
    const auto is_known = [&] {
        if (!options_.background && mean.error_of_open() > effort_.error) return false;
        return mean.error() <= effort_.error;
    };
    for (std::uint32_t k = 0; k < effort_.most_rays; ++k) {
        const bool is_doubled = k >= least && std::has_single_bit(k);
        if (is_doubled && is_known()) break;
        const bool is_first = k < first_rays;
        const Point place =
            is_first ? first_point(k) : even_point(k, shift.of_rays[0], shift.of_rays[1]);
        const float sampled = is_first ? 0.5F : width;
        PixelLight light;
        const auto see = [&](const Seen& seen, float part) {
            const OfLights<float> parts = shares(seen, k);
            add(light_of_ray(seen, parts.sun, parts.sky), part, light);
        };
        const Seen seen = is_first ? first[k] : trace(pixel, place, sampled);
        if (!seen.is_translucent) see(seen, 1);
        else {
            tracer_.trace_through(static_cast<float>(left_ + pixel.x) + place.x,
                                  static_cast<float>(top_ + pixel.y) + place.y, sampled, see);
        }
        mean.add(light);
    }
    return mean.light();
}

}  // namespace cascade
