// Draws a picture in independent tiles.
#pragma once

#include "picture/image.h"
#include "render/pixel_light.h"
#include "render/quality.h"
#include "render/samples.h"
#include "render/tracer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// Draws tiles. Has memory for one tile, so each thread needs its own drawer. The arguments must
/// outlive the drawer.
class TileDrawer {
public:
    static constexpr std::int64_t side = 96;  ///< In pixels.

    TileDrawer(const Tracer& tracer, const DrawOptions& options);

    /// Sets the tile's pixels, which depend neither on other tiles nor on their order.
    void draw(std::int64_t left, std::int64_t top, Image& image);

private:
    /// The width, in pixels, of the border around the tile that is traced together with it.
    static constexpr std::int64_t margin = 4;
    static constexpr std::int64_t room_side = side + 2 * margin;

    /// Counts the tests for a light, and the tests in which the light was visible.
    struct Tally {
        std::uint16_t asked = 0, seen = 0;
        Tally& operator+=(Tally other) {
            asked = static_cast<std::uint16_t>(asked + other.asked);
            seen = static_cast<std::uint16_t>(seen + other.seen);
            return *this;
        }
        bool is_partial() const { return seen > 0 && seen < asked; }
        float share() const {
            return asked > 0 ? static_cast<float>(seen) / static_cast<float>(asked) : 1.0F;
        }
    };
    enum class Light : std::uint8_t { sun, sky };
    /// A value for each light.
    template <typename T>
    struct OfLights {
        T sun{}, sky{};
        T& operator[](Light light) { return light == Light::sun ? sun : sky; }
        const T& operator[](Light light) const { return light == Light::sun ? sun : sky; }
    };
    struct Pixel {
        Seen seen;      ///< The hit of the ray through the pixel's middle.
        Colour tone{};  ///< The tone that the hit would have if no light were hidden.
        OfLights<Tally> first, all;
        /// For each light, whether it is partly hidden at this pixel or nearby.
        OfLights<bool> is_partly_hidden;
        bool is_edge = false;    ///< Whether adjacent pixels show something else.
        bool is_varied = false;  ///< Whether adjacent pixels show other colours of the same thing.
        std::int16_t x = 0, y = 0;  ///< Position relative to `left_` and `top_`.
    };
    using Rays = std::array<Seen, first_rays>;

    template <typename Use>
    void visit(std::int64_t around, const Use& use);
    template <typename Use>
    void visit_around(const Pixel& pixel, int reach, const Use& use);
    template <typename Use>
    void visit_sides(const Pixel& pixel, const Use& use) const;

    Seen trace(const Pixel& pixel, Point place, float width) const;
    Tally ask(Light light, const Seen& from, Point place) const;
    Tally ask_in_turn(Light light, const Pixel& pixel, std::uint32_t round) const;
    bool is_one_piece(const Seen& a, const Seen& b) const;

    void look(Pixel& pixel);
    void look_beside(Pixel& pixel);
    void ask_more(Light light, Pixel& pixel);
    PixelLight light_of_pixel(Pixel& pixel);
    bool is_at_outline_of_shadow(const Pixel& pixel, float share) const;
    Rays first_rays_of(const Pixel& pixel) const;
    float share_around(Light light, Pixel& pixel, int reach);
    bool is_in_thicket(const Pixel& pixel, const Rays& rays);
    PixelLight light_in_thicket(const Pixel& pixel, const Rays& rays);
    template <typename Shares>
    PixelLight light_of_rays(const Pixel& pixel, const Rays& first, std::uint32_t least,
                             const Shares& shares);
    Shifts shifts(const Pixel& pixel) const { return shifts_of(left_ + pixel.x, top_ + pixel.y); }

    const Tracer& tracer_;
    const DrawOptions& options_;
    const Effort effort_;
    /// The position in the picture from which pixels of the tile are counted.
    std::int64_t left_ = 0, top_ = 0;
    std::vector<Pixel> room_;  ///< The tile and the pixels around it.
};

}  // namespace cascade
