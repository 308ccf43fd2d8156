// The table of expected looks.
#include "tests/oracle/recipe_looks.h"

#include <array>

namespace cascade {

namespace {

using enum Measure;

constexpr auto looks = std::to_array<Look>({
    // Turing's spots: the wavelength of linear theory is 2π √(diff_b / ka), 19.9 and 9.9 cells.
    {"figure_3_3_spots", 1, "b", regions_below, 4, {8, 10}, {34, 40}},
    {"figure_3_3_spots", 1, "b", area_below, 4, {.24, .28}, {.24, .28}},
    {"figure_3_3_spots", 1, "b", peak_wavelength, 0, {18.5, 20.2}, {18.2, 20.2}},
    {"figure_3_3_small_spots", 1, "b", regions_below, 4, {36, 42}, {143, 162}},
    {"figure_3_3_small_spots", 1, "b", area_below, 4, {.24, .28}, {.24, .28}},
    {"figure_3_3_small_spots", 1, "b", peak_wavelength, 0, {9.0, 9.9}, {9.0, 9.9}},
    {"figure_3_4_irregular_spots", 1, "b", regions_below, 4, {7, 11}, {32, 41}},
    {"figure_3_4_irregular_spots", 1, "b", deviation, 0, {1.84, 2.0}, {1.84, 2.0}},

    // Cheetah: large spots remain, and small spots grow between them.
    {"cheetah", 1, "b", regions_below, 4, {14, 17}, {55, 63}},
    {"cheetah", 2, "b", regions_below, 4, {38, 50}, {155, 180}},
    {"cheetah", 2, "b", area_below, 4, {.36, .41}, {.37, .40}},

    // Leopard: the frozen discs are grey, and each has about three small spots.
    {"leopard", 1, "b", regions_below, 4, {8, 10}, {34, 40}},
    {"leopard", 2, "b", regions_below, 4, {22, 31}, {94, 113}},
    {"leopard", 2, "b", peak_wavelength, 0, {9.2, 10}, {9.2, 10}},

    // Stripes: the wavelength is 21 for diff1 = .04, and 15 for diff1 = .03.
    {"figure_3_4_random_stripes", 1, "b", peak_wavelength, 0, {20, 22}, {20, 22}},
    {"figure_3_4_random_stripes", 1, "b", area_below, .75, {.42, .58}, {.46, .54}},
    {"lionfish", 1, "b", peak_wavelength, 0, {20, 22}, {20, 22}},
    {"lionfish", 1, "b", deviation, 0, {.44, .48}, {.44, .48}},
    {"lionfish", 2, "b", mean_wavelength, 0, {8.1, 9.1}, {8.1, 9.1}},
    {"lionfish", 2, "b", area_below, .75, {.62, .70}, {.62, .70}},
    {"figure_3_4_mixed_stripes", 2, "b", mean_wavelength, 0, {7.9, 9.1}, {7.9, 9.1}},
    {"figure_3_4_mixed_stripes", 2, "b", area_below, .75, {.62, .70}, {.62, .70}},
    {"eroded_stripes", 1, "b", peak_wavelength, 0, {20, 22}, {20, 22}},
    {"eroded_stripes", 2, "b", mean_wavelength, 0, {9, 11.2}, {9, 11.2}},
    {"eroded_stripes", 2, "b", deviation, 0, {.57, .63}, {.57, .63}},
    {"thin_lines", 1, "b", peak_wavelength, 0, {14.4, 16.2}, {14.4, 16.2}},
    {"thin_lines", 2, "b", area_below, 4, {.24, .28}, {.24, .28}},
    {"thin_lines", 2, "b", regions_below, 4, {1, 6}, {4, 22}},

    // Reticulation: a spot with a seam around it is a plate, and a web separates most plates.
    {"figure_3_4_reticulation", 2, "a", area_below, .75, {.45, .49}, {.45, .49}},
    {"figure_3_4_reticulation", 2, "a", regions_below, .75, {2, 8}, {16, 23}},
    {"figure_3_4_reticulation", 2, "a", regions_above, .75, {6, 10}, {21, 28}},

    // Autocatalysis: bright dots.
    {"autocatalytic_spots", 1, "a", regions_above, 3, {17, 22}, {76, 88}},
    {"autocatalytic_spots", 1, "a", area_above, 3, {.05, .09}, {.05, .09}},
    {"vary_spots", 1, "a", regions_above, 3.2, {84, 95}, {335, 385}},
    {"bumpy_stripes", 1, "a", peak_wavelength, 0, {8.1, 8.8}, {8.1, 8.8}},
    {"bumpy_stripes", 1, "a", bumps, 0, {15, 36}, {85, 150}},
    {"mixed_spots", 2, "a", mean_wavelength, 0, {2.7, 2.9}, {2.7, 2.9}},
    {"mixed_spots", 2, "a", area_below, 3.3, {.92, .96}, {.92, .96}},

    // The spots of stage 1 are a lattice for stage 2.
    {"small_spots", 1, "b", regions_below, 4, {14, 17}, {55, 63}},
    {"small_spots", 1, "b", area_below, 4, {.25, .285}, {.25, .28}},
    {"small_spots", 2, "b", regions_below, 4, {14, 17}, {55, 63}},
    {"small_spots", 2, "b", area_below, 4, {.07, .1}, {.07, .1}},
    {"honeycomb", 1, "b", regions_below, 4, {14, 17}, {55, 63}},
    {"honeycomb", 2, "b", regions_below, 4, {1, 1}, {1, 1}},
    {"honeycomb", 2, "b", regions_above, 7.6, {14, 21}, {56, 80}},
    {"honeycomb", 2, "b", peak_wavelength, 0, {14.3, 15.8}, {14.5, 15.8}},
    {"wide_spots", 1, "b", regions_below, 4, {11, 13}, {46, 52}},
    {"wide_spots", 2, "a", regions_above, .75, {11, 13}, {46, 56}},
    {"wide_spots", 2, "a", area_above, .75, {.46, .53}, {.46, .53}},
    {"plates", 2, "a", regions_above, .75, {27, 35}, {106, 125}},
    {"plates", 2, "a", area_above, .75, {.44, .50}, {.44, .50}},
    {"plates", 2, "a", peak_wavelength, 0, {9.6, 10.8}, {10, 11}},

    // Broken lines: spots of stage 1 become a labyrinth of dots and short lines.
    {"broken_lines", 1, "b", regions_below, 4, {11, 13}, {46, 52}},
    {"broken_lines", 2, "b", regions_below, 4, {18, 36}, {95, 135}},
    {"broken_lines", 2, "b", peak_wavelength, 0, {8, 8.9}, {8, 8.8}},

    // Squirrel: three pairs of straight stripes and a row of spots between them. On 128 × 128,
    // noise of the printed strength breaks the stripes.
    {"squirrel", 1, "b", anisotropy, 0, {.96, 1}, {.4, .75}},
    {"squirrel", 1, "b", regions_below, .75, {3, 3}, {2, 7}},
    {"squirrel", 2, "b", regions_below, 3, {12, 18}, {45, 60}},
});

}  // namespace

std::span<const Look> recipe_looks() { return looks; }

}  // namespace cascade
