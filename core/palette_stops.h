// The colours of the palettes, which palette.cpp names.
#pragma once

#include "core/palette.h"

#include <array>
#include <cstdint>

namespace cascade::palette_stops {

/// A colour 0xRRGGBB.
constexpr Colour hex(std::uint32_t rgb) {
    const auto channel = [rgb](int shift) {
        return static_cast<float>((rgb >> shift) & 0xffU) / 255.0F;
    };
    return {channel(16), channel(8), channel(0)};
}

constexpr std::array<Colour, 2> grey{{hex(0x000000), hex(0xffffff)}};

// Perceptual maps, sampled at 17 equal distances from their tables of 256 colours. Linear
// interpolation stays within 0.025 of the tables (cividis: 0.042, at a bend of its dark end).
// viridis, magma, inferno, plasma: S. van der Walt, N. Smith, E. Firing, 2015, public domain (CC0).
// cividis: J. R. Nuñez, C. R. Anderton, R. S. Renslow, "Optimizing colormaps with consideration
// for color vision deficiency to enable accurate interpretation of scientific data", PLOS ONE
// 13(7), 2018.

// clang-format off
constexpr std::array<Colour, 17> viridis{{
    {0.2670F, 0.0049F, 0.3294F}, {0.2823F, 0.0946F, 0.4170F}, {0.2789F, 0.1749F, 0.4830F},
    {0.2593F, 0.2507F, 0.5244F}, {0.2302F, 0.3213F, 0.5455F}, {0.2000F, 0.3864F, 0.5545F},
    {0.1733F, 0.4474F, 0.5579F}, {0.1497F, 0.5064F, 0.5573F}, {0.1281F, 0.5651F, 0.5509F},
    {0.1203F, 0.6238F, 0.5343F}, {0.1554F, 0.6815F, 0.5032F}, {0.2415F, 0.7366F, 0.4545F},
    {0.3629F, 0.7867F, 0.3866F}, {0.5081F, 0.8292F, 0.2992F}, {0.6694F, 0.8622F, 0.1954F},
    {0.8359F, 0.8861F, 0.1025F}, {0.9932F, 0.9062F, 0.1439F},
}};

constexpr std::array<Colour, 17> magma{{
    {0.0015F, 0.0005F, 0.0139F}, {0.0394F, 0.0309F, 0.1330F}, {0.1124F, 0.0653F, 0.2756F},
    {0.2104F, 0.0622F, 0.4173F}, {0.3151F, 0.0712F, 0.4848F}, {0.4128F, 0.1096F, 0.5045F},
    {0.5105F, 0.1473F, 0.5077F}, {0.6108F, 0.1809F, 0.4990F}, {0.7132F, 0.2139F, 0.4762F},
    {0.8135F, 0.2542F, 0.4381F}, {0.9013F, 0.3165F, 0.3899F}, {0.9592F, 0.4135F, 0.3599F},
    {0.9859F, 0.5300F, 0.3801F}, {0.9959F, 0.6477F, 0.4423F}, {0.9970F, 0.7633F, 0.5296F},
    {0.9928F, 0.8776F, 0.6335F}, {0.9871F, 0.9914F, 0.7495F},
}};

constexpr std::array<Colour, 17> inferno{{
    {0.0015F, 0.0005F, 0.0139F}, {0.0420F, 0.0280F, 0.1406F}, {0.1285F, 0.0473F, 0.2896F},
    {0.2370F, 0.0366F, 0.3956F}, {0.3399F, 0.0618F, 0.4292F}, {0.4393F, 0.0986F, 0.4317F},
    {0.5386F, 0.1339F, 0.4157F}, {0.6375F, 0.1704F, 0.3822F}, {0.7328F, 0.2143F, 0.3321F},
    {0.8195F, 0.2728F, 0.2685F}, {0.8918F, 0.3500F, 0.1965F}, {0.9451F, 0.4448F, 0.1188F},
    {0.9774F, 0.5526F, 0.0380F}, {0.9879F, 0.6692F, 0.0596F}, {0.9759F, 0.7909F, 0.1973F},
    {0.9486F, 0.9109F, 0.3962F}, {0.9884F, 0.9984F, 0.6449F},
}};

constexpr std::array<Colour, 17> plasma{{
    {0.0504F, 0.0298F, 0.5280F}, {0.1929F, 0.0184F, 0.5901F}, {0.2991F, 0.0096F, 0.6314F},
    {0.3983F, 0.0009F, 0.6560F}, {0.4934F, 0.0115F, 0.6580F}, {0.5827F, 0.0672F, 0.6335F},
    {0.6633F, 0.1369F, 0.5869F}, {0.7342F, 0.2075F, 0.5295F}, {0.7964F, 0.2780F, 0.4713F},
    {0.8515F, 0.3490F, 0.4157F}, {0.9000F, 0.4222F, 0.3618F}, {0.9410F, 0.4992F, 0.3081F},
    {0.9722F, 0.5817F, 0.2541F}, {0.9908F, 0.6706F, 0.2010F}, {0.9934F, 0.7663F, 0.1566F},
    {0.9762F, 0.8684F, 0.1434F}, {0.9400F, 0.9752F, 0.1313F},
}};

constexpr std::array<Colour, 17> cividis{{
    {0.0000F, 0.1351F, 0.3048F}, {0.0000F, 0.1786F, 0.4143F}, {0.1024F, 0.2201F, 0.4359F},
    {0.1942F, 0.2639F, 0.4260F}, {0.2627F, 0.3072F, 0.4228F}, {0.3231F, 0.3504F, 0.4261F},
    {0.3795F, 0.3941F, 0.4354F}, {0.4337F, 0.4385F, 0.4506F}, {0.4869F, 0.4839F, 0.4707F},
    {0.5457F, 0.5302F, 0.4718F}, {0.6067F, 0.5779F, 0.4641F}, {0.6693F, 0.6272F, 0.4489F},
    {0.7334F, 0.6782F, 0.4253F}, {0.7993F, 0.7312F, 0.3921F}, {0.8670F, 0.7865F, 0.3462F},
    {0.9369F, 0.8441F, 0.2806F}, {0.9957F, 0.9093F, 0.2178F},
}};

// Animal coats, drawn for this project. They run from the dark colour of the markings to the light
// colour of the background, so that a species with low values in its spots (b of turing_spots)
// resembles the animal.

constexpr std::array<Colour, 9> leopard{{
    hex(0x1b120b), hex(0x26180d), hex(0x49301a), hex(0x875a2c), hex(0xb27c3e),
    hex(0xcc9a57), hex(0xdfb675), hex(0xedcf97), hex(0xf7e4bb),
}};

constexpr std::array<Colour, 9> cheetah{{
    hex(0x15100c), hex(0x1c1510), hex(0x2f2317), hex(0x6e5130), hex(0xb48d57),
    hex(0xd3b07a), hex(0xe3c795), hex(0xeed9b0), hex(0xf5e8cb),
}};

constexpr std::array<Colour, 9> tan{{
    hex(0x4a2c16), hex(0x6a4424), hex(0x8a5f38), hex(0xa67a4f), hex(0xbd9468),
    hex(0xd0ac83), hex(0xdfc39f), hex(0xecd8bd), hex(0xf6ebd8),
}};

constexpr std::array<Colour, 9> zebra{{
    hex(0x12100f), hex(0x171412), hex(0x231f1c), hex(0x4d4640), hex(0x9c9388),
    hex(0xd6cec0), hex(0xece6da), hex(0xf4f0e6), hex(0xfaf7f0),
}};

constexpr std::array<Colour, 9> giraffe{{
    hex(0x43200f), hex(0x5c2e14), hex(0x773f1b), hex(0x925324), hex(0xab6c36),
    hex(0xc79259), hex(0xe2bf8d), hex(0xf2ddb6), hex(0xf9eed3),
}};

constexpr std::array<Colour, 9> coral{{
    hex(0x38091d), hex(0x6a1230), hex(0x9d2140), hex(0xcc3c4b), hex(0xea6559),
    hex(0xf78f72), hex(0xfbb796), hex(0xfdd9bf), hex(0xfff3e6),
}};

constexpr std::array<Colour, 9> lionfish{{
    hex(0x260a0c), hex(0x461114), hex(0x6d1d1b), hex(0x913528), hex(0xae5a41),
    hex(0xca8a6b), hex(0xe2b99c), hex(0xf2dfcd), hex(0xfcf4ea),
}};

constexpr std::array<Colour, 9> angelfish{{
    hex(0x0a1230), hex(0x102a5e), hex(0x15488a), hex(0x1f6ca6), hex(0x358fb0),
    hex(0x66b0a9), hex(0xa4c98d), hex(0xdcd87a), hex(0xfbec9a),
}};

constexpr std::array<Colour, 9> dart_frog{{
    hex(0x05070d), hex(0x08132e), hex(0x0b2560), hex(0x1040a0), hex(0x1a63d6),
    hex(0x3d8bf0), hex(0x74b2f8), hex(0xaed4fb), hex(0xe2f2fe),
}};
// clang-format on

}  // namespace cascade::palette_stops
