// Adaptive sampling: few rays where the picture is smooth, more where they differ.
//
// Every pixel begins with four rays; two of them test the sun, the others the sky.
// - Where the rays or the neighbouring pixels hit different things there is an edge, and the pixel
//   sends all its rays, each of which tests both lights.
// - Where only their colours differ, the pixel sends all its rays, but tests the lights as if they
//   agreed.
// - Where there are copies and edges all around, as in fur, no outline stands out: a pixel keeps to
//   its first rays, and takes the visible parts of the lights from the pixels around, too.
// - Where a light is partly hidden around a pixel, the pixel tests it more often.
// - The visible part of the sky varies slowly along a surface. Pixels away from edges use the mean
//   over their neighbours on the same surface.
#include "render/draw.h"

#include "picture/srgb.h"
#include "render/samples.h"
#include "render/tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

namespace cascade {

namespace {

constexpr std::int64_t tile_side = 64;  ///< Pixels.
constexpr std::int64_t filter_reach =
    2;  ///< Pixels on each side whose answers about the sky count.
// How often each ray asks for a light that is partly hidden.
constexpr std::uint32_t sun_rounds = 16;
constexpr std::uint32_t sun_rounds_of_copies = 4;  ///< Shadows on small things are small.
constexpr std::uint32_t sky_rounds = 2;
constexpr std::uint32_t edge_rounds = 2;  ///< For both lights, at an edge.
/// Two hits whose normals have a smaller cosine are not on one piece of a surface.
constexpr float least_cosine = 0.9F;
// Contrasts of light above which all rays are sent.
constexpr float contrast_in_pixel = 0.12F;  ///< Between the first rays of a pixel.
constexpr float contrast_beside = 0.3F;     ///< Between a pixel and its neighbours.

/// The results of visibility tests of a light.
struct Tally {
    std::uint32_t asked = 0, seen = 0;
    Tally& operator+=(Tally other) {
        asked += other.asked;
        seen += other.seen;
        return *this;
    }
    bool is_partial() const { return seen > 0 && seen < asked; }
    float share() const {
        return asked > 0 ? static_cast<float>(seen) / static_cast<float>(asked) : 1.0F;
    }
};

void add(const Colour& light, float part, Colour& sum) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c] * part;
}

Colour full_light(const Seen& seen) {
    Colour sum = seen.always;
    add(seen.of_sun, 1, sum);
    add(seen.of_sky, 1, sum);
    return sum;
}

float contrast(const Colour& a, const Colour& b) {
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

/// A pixel after its first rays.
struct Pixel {
    std::int64_t x = 0, y = 0;
    Shifts shifts;
    std::array<Seen, first_rays> seen;
    Colour light{0, 0, 0};   ///< The mean of the rays, were nothing hidden.
    bool is_mixed = false;   ///< The first rays hit different things.
    bool is_varied = false;  ///< The first rays, or the pixels beside, hit different colours.
    Tally sun, sky;
    Tally more_sky;  ///< All answers, where it was asked for more often.
    bool is_edge = false;
};

/// Draws tiles of a picture. Has room for one tile, so each thread needs its own.
class TileDrawer {
public:
    TileDrawer(const Tracer& tracer, const DrawOptions& options)
        : tracer_(tracer),
          options_(options),
          rays_(static_cast<std::uint32_t>(options.samples) *
                static_cast<std::uint32_t>(options.samples)),
          first_(std::min<std::uint32_t>(first_rays, rays_)),
          first_tests_(std::max(1u, first_ / 2)),
          first_width_(1 / std::sqrt(static_cast<float>(first_))) {}

    void draw(std::int64_t left, std::int64_t top, Image& image) {
        begin(left, top);
        visit(filter_reach + 1, [&](Pixel& pixel) { send_first(pixel); });
        visit(filter_reach, [&](Pixel& pixel) {
            look_beside(pixel);
            pixel.more_sky = pixel.sky;
            const bool is_smooth = !pixel.is_edge && !pixel.seen[0].is_copy;
            if (is_smooth && around(pixel, &Pixel::sky).is_partial()) ask_sky(pixel);
        });
        visit(0, [&](const Pixel& pixel) {
            Colour light = is_in_thicket(pixel) ? thicket_light(pixel)
                           : pixel.is_edge      ? edge_light(pixel)
                                                : even_light(pixel);
            for (float& channel : light) channel = stored_of(channel);
            image.at(pixel.x, pixel.y) = light;
        });
    }

private:
    static constexpr std::int64_t margin = filter_reach + 1, room_side = tile_side + 2 * margin;

    void begin(std::int64_t left, std::int64_t top) {
        left_ = left;
        top_ = top;
        room_.assign(static_cast<std::size_t>(room_side * room_side), Pixel());
        for (std::int64_t y = top - margin; y < top + tile_side + margin; ++y) {
            for (std::int64_t x = left - margin; x < left + tile_side + margin; ++x) {
                at(x, y).x = x;
                at(x, y).y = y;
                at(x, y).shifts = shifts_of(x, y);
            }
        }
    }
    Pixel& at(std::int64_t x, std::int64_t y) {
        return room_[static_cast<std::size_t>((y - top_ + margin) * room_side + x - left_ +
                                              margin)];
    }
    bool is_inside(std::int64_t x, std::int64_t y) const {
        return x >= 0 && y >= 0 && x < options_.width && y < options_.height;
    }

    /// The pixels of the tile, and those of the picture at most `around` beside it.
    template <typename Use>
    void visit(std::int64_t around, const Use& use) {
        for (std::int64_t y = top_ - around; y < top_ + tile_side + around; ++y) {
            for (std::int64_t x = left_ - around; x < left_ + tile_side + around; ++x) {
                if (is_inside(x, y)) use(at(x, y));
            }
        }
    }
    /// The pixels of the picture in the square around a pixel, itself among them.
    template <typename Use>
    void visit_around(const Pixel& pixel, std::int64_t reach, const Use& use) {
        for (std::int64_t j = pixel.y - reach; j <= pixel.y + reach; ++j) {
            for (std::int64_t i = pixel.x - reach; i <= pixel.x + reach; ++i) {
                if (is_inside(i, j)) use(at(i, j));
            }
        }
    }
    Tally around(const Pixel& pixel, Tally Pixel::*tally) {
        Tally sum;
        visit_around(pixel, 1, [&](const Pixel& each) { sum += each.*tally; });
        return sum;
    }

    Seen trace(std::uint32_t k, const Pixel& pixel, float width) const {
        const auto& shift = pixel.shifts.of_rays_and_sun;
        const Point place = k < first_ ? first_point(k, first_) : even_point(k, shift[0], shift[1]);
        return tracer_.trace(static_cast<float>(pixel.x) + place.x,
                             static_cast<float>(pixel.y) + place.y, width);
    }
    Tally asked_sun(const Seen& from, std::uint32_t number, const Pixel& pixel) const {
        const auto& shift = pixel.shifts.of_rays_and_sun;
        return {1,
                tracer_.sees_sun(from, on_disc(even_point(number, shift[2], shift[3]))) ? 1u : 0u};
    }
    Tally asked_sky(const Seen& from, std::uint32_t number, const Pixel& pixel) const {
        const auto& shift = pixel.shifts.of_sky;
        return {1,
                tracer_.sees_sky(from, on_disc(even_point(number, shift[0], shift[1]))) ? 1u : 0u};
    }

    /// Whether two hits, in a pixel or in neighbouring ones, are on one piece of a surface.
    bool is_one_piece(const Seen& a, const Seen& b) const {
        if (a.kind != b.kind) return false;
        if (a.kind == Seen::Kind::background) return true;
        const float near = 3 * tracer_.pixel_at(a.place);
        return dot(a.normal, b.normal) >= least_cosine &&
               std::abs(dot(a.normal, b.place - a.place)) <= near;
    }

    void send_first(Pixel& pixel) const {
        bool is_torn = false;
        Colour low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
        for (std::uint32_t k = 0; k < first_; ++k) {
            Seen& seen = pixel.seen[k];
            seen = trace(k, pixel, first_width_);
            if (seen.kind != pixel.seen[0].kind) pixel.is_mixed = true;
            is_torn = is_torn || !is_one_piece(pixel.seen[0], seen);
            const Colour light = full_light(seen);
            add(light, 1 / static_cast<float>(first_), pixel.light);
            for (std::size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], light[c]);
                high[c] = std::max(high[c], light[c]);
            }
            if (seen.kind == Seen::Kind::background) continue;
            if (k % 2 == 0) pixel.sun += asked_sun(seen, k / 2, pixel);
            if (k % 2 == 1 || first_ == 1) pixel.sky += asked_sky(seen, k / 2, pixel);
        }
        if (contrast(low, high) > contrast_in_pixel) {
            (is_torn ? pixel.is_mixed : pixel.is_varied) = true;
        }
    }

    void look_beside(Pixel& pixel) {
        pixel.is_edge = pixel.is_mixed;
        visit_around(pixel, 1, [&](const Pixel& other) {
            const Seen &own = pixel.seen[0], &there = other.seen[0];
            if (own.kind != there.kind) {
                pixel.is_edge = true;
            } else if (contrast(other.light, pixel.light) > contrast_beside) {
                (is_one_piece(own, there) ? pixel.is_varied : pixel.is_edge) = true;
            }
        });
    }

    void ask_sky(Pixel& pixel) const {
        for (std::uint32_t number = first_tests_; number < sky_rounds * first_; ++number) {
            pixel.more_sky += asked_sky(pixel.seen[number % first_], number, pixel);
        }
    }

    /// Puts `count` rays of a pixel into `all_`.
    void send_all(const Pixel& pixel, std::uint32_t count) {
        all_.assign(pixel.seen.begin(), pixel.seen.begin() + first_);
        const float width = 1 / static_cast<float>(options_.samples);
        for (std::uint32_t k = first_; k < count; ++k) all_.push_back(trace(k, pixel, width));
    }

    /// Of a pixel whose rays hit the same thing.
    Colour even_light(const Pixel& pixel) {
        if (pixel.seen[0].kind == Seen::Kind::background) return pixel.light;
        Tally sun = pixel.sun;
        if (around(pixel, &Pixel::sun).is_partial()) {
            const std::uint32_t rounds = pixel.seen[0].is_copy ? sun_rounds_of_copies : sun_rounds;
            for (std::uint32_t number = first_tests_; number < rounds * first_; ++number) {
                sun += asked_sun(pixel.seen[number % first_], number, pixel);
            }
        }
        const Seen& own = pixel.seen[0];
        Tally sky;
        visit_around(pixel, filter_reach, [&](const Pixel& other) {
            const Seen& there = other.seen[0];
            if (!other.is_edge && is_one_piece(own, there)) sky += other.more_sky;
        });
        send_all(pixel, pixel.is_varied ? rays_ : first_);
        Colour light{0, 0, 0};
        const float part = 1 / static_cast<float>(all_.size());
        for (const Seen& each : all_) {
            add(each.always, part, light);
            add(each.of_sun, part * sun.share(), light);
            add(each.of_sky, part * sky.share(), light);
        }
        return light;
    }

    /// Whether this pixel shows nothing but copies, and a sixth of those around have edges.
    bool is_in_thicket(const Pixel& pixel) {
        bool is_one = first_ == first_rays;
        for (const Seen& seen : pixel.seen) is_one = is_one && seen.is_copy;
        if (!is_one) return false;
        int count = 0, edges = 0;
        visit_around(pixel, filter_reach, [&](const Pixel& other) {
            ++count;
            if (other.is_edge) ++edges;
        });
        return 6 * edges >= count;
    }

    /// Of the first rays, with the shares of the lights that are seen from here and around.
    Colour thicket_light(const Pixel& pixel) {
        Tally sun, sky;
        visit_around(pixel, 1, [&](const Pixel& other) {
            if (!other.seen[0].is_copy) return;
            sun += other.sun;
            sky += other.sky;
        });
        for (std::uint32_t k = 0; k < first_; ++k) {
            const Seen& seen = pixel.seen[k];
            if (k % 2 == 0) sky += asked_sky(seen, first_ + k, pixel);
            else sun += asked_sun(seen, first_ + k, pixel);
        }
        Colour sum{0, 0, 0};
        for (const Seen& seen : pixel.seen) {
            add(seen.of_sun, sun.share() / first_rays, sum);
            add(seen.of_sky, sky.share() / first_rays, sum);
        }
        return sum;
    }

    /// Of all rays that a pixel may have.
    Colour edge_light(const Pixel& pixel) {
        send_all(pixel, rays_);
        Colour sum{0, 0, 0};
        for (const Seen& each : all_) add(each.always, 1, sum);
        add_light(&Seen::of_sun, sum, [&](const Seen& from, std::uint32_t number) {
            return asked_sun(from, number, pixel);
        });
        add_light(&Seen::of_sky, sum, [&](const Seen& from, std::uint32_t number) {
            return asked_sky(from, number, pixel);
        });
        for (float& channel : sum) channel /= static_cast<float>(rays_);
        return sum;
    }

    /// Adds the light of one source that reaches `all_`; `asks(from, number)` tests its visibility
    /// for sample `number`.
    template <typename Asks>
    void add_light(Colour Seen::*light, Colour& sum, const Asks& asks) const {
        Colour found{0, 0, 0};
        Tally tally;
        std::uint32_t number = 0;
        const auto ask_all = [&] {
            for (const Seen& from : all_) {
                ++number;
                if (from.kind == Seen::Kind::background) continue;
                const Tally answer = asks(from, number - 1);
                tally += answer;
                if (answer.seen > 0) add(from.*light, 1, found);
            }
        };
        ask_all();
        const std::uint32_t rounds = tally.is_partial() && !all_[0].is_copy ? edge_rounds : 1;
        for (std::uint32_t round = 1; round < rounds; ++round) ask_all();
        add(found, 1 / static_cast<float>(rounds), sum);
    }

    const Tracer& tracer_;
    const DrawOptions& options_;
    std::uint32_t rays_, first_;
    std::uint32_t first_tests_;  ///< Of each light by the first rays, which take turns.
    float first_width_;          ///< Of what a first ray stands for, in pixels.
    std::int64_t left_ = 0, top_ = 0;
    std::vector<Pixel> room_;  ///< The tile and the pixels around it.
    std::vector<Seen> all_;    ///< The rays of one pixel.
};

}  // namespace

Image draw(const RayCaster& caster, const SurfaceLook& look, const DrawOptions& options,
           Team& team) {
    const Tracer tracer(caster, look, options);
    Image image(options.width, options.height);
    const std::int64_t columns = (options.width + tile_side - 1) / tile_side;
    const std::int64_t rows = (options.height + tile_side - 1) / tile_side;
    std::atomic<std::int64_t> next{0};
    team.run([&](int) {
        TileDrawer drawer(tracer, options);
        for (std::int64_t tile = next++; tile < columns * rows; tile = next++) {
            drawer.draw(tile % columns * tile_side, tile / columns * tile_side, image);
        }
    });
    return image;
}

Image draw(const TriangleMesh& mesh, const SurfaceColour& colour, const DrawOptions& options,
           Team& team) {
    const RayCaster caster(mesh);
    const auto look = [&](const Sight& sight) {
        Look result;
        result.light = colour(sight.hit);
        for (float& channel : result.light) channel = light_of(channel);
        return result;
    };
    return draw(caster, look, options, team);
}

}  // namespace cascade
