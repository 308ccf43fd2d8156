// Slices of volumes, and volume files.
#include "picture/npy.h"
#include "picture/slice.h"
#include "picture/vti.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A field with the value 100 k + 10 j + i in cell (i, j, k).
Field places(std::int64_t width, std::int64_t height, std::int64_t depth) {
    Field field{PlaneLayout(Grid{width, height, {}, depth})};
    for (std::int64_t k = 0; k < depth; ++k) {
        for (std::int64_t j = 0; j < height; ++j) {
            for (std::int64_t i = 0; i < width; ++i) {
                field.at(i, j, k) = static_cast<float>(100 * k + 10 * j + i);
            }
        }
    }
    return field;
}

std::vector<float> cells(const Field& field) {
    std::vector<float> values;
    for (std::int64_t row = 0; row < field.layout().row_count(); ++row) {
        values.insert(values.end(), field.row(row), field.row(row) + field.layout().width);
    }
    return values;
}

TEST(Slice, AcrossEachAxis) {
    const Field volume = places(2, 3, 4);
    const Field across_z = cut(volume, {Axis::z, 0.5});
    EXPECT_EQ(across_z.layout(), PlaneLayout(Grid{2, 3}));
    EXPECT_THAT(cells(across_z), ElementsAre(200, 201, 210, 211, 220, 221));
    const Field across_y = cut(volume, {Axis::y, 1});
    EXPECT_EQ(across_y.layout(), PlaneLayout(Grid{2, 4}));
    EXPECT_THAT(cells(across_y), ElementsAre(20, 21, 120, 121, 220, 221, 320, 321));
    const Field across_x = cut(volume, {Axis::x, 0});
    EXPECT_EQ(across_x.layout(), PlaneLayout(Grid{4, 3}));
    EXPECT_THAT(cells(across_x),
                ElementsAre(0, 100, 200, 300, 10, 110, 210, 310, 20, 120, 220, 320));
}

TEST(Slice, PlacesAreCells) {
    const PlaneLayout layout(Grid{5, 5, {}, 10});
    EXPECT_EQ(slice_number(layout, {Axis::z, 0}), 0);
    EXPECT_EQ(slice_number(layout, {Axis::z, 0.099}), 0);
    EXPECT_EQ(slice_number(layout, {Axis::z, 0.5}), 5);
    EXPECT_EQ(slice_number(layout, {Axis::z, 1}), 9);
}

TEST(Volume, FilesHoldTheirArraysWhereTheySay) {
    Field first = places(2, 3, 4);
    const Field second = places(2, 3, 4);
    first.at(1, 0, 0) = -std::nanf("7");
    const VolumeArray arrays[] = {{"u", &first}, {"a<b", &second}};
    const std::string file = encode_vti(arrays, {0.25, 0.25, 0.25});
    EXPECT_THAT(file, HasSubstr("<ImageData WholeExtent=\"0 2 0 3 0 4\" Origin=\"0 0 0\" "
                                "Spacing=\"0.25 0.25 0.25\">"));
    EXPECT_THAT(file, HasSubstr("Name=\"u\" format=\"appended\" offset=\"0\"/>"));
    EXPECT_THAT(file, HasSubstr("Name=\"a&lt;b\" format=\"appended\" offset=\"104\"/>"));
    const std::size_t begin = file.find("\n_") + 2;
    for (const std::size_t offset : {std::size_t{0}, std::size_t{104}}) {
        std::uint64_t size = 0;
        std::memcpy(&size, file.data() + begin + offset, 8);
        ASSERT_EQ(size, 24u * 4);
        std::vector<float> values(24);
        std::memcpy(values.data(), file.data() + begin + offset + 8, size);
        EXPECT_EQ(values[0], 0);
        if (offset == 0) {
            std::uint32_t nan_word = 0;
            std::memcpy(&nan_word, &values[1], 4);
            EXPECT_EQ(nan_word, 0x7fc00000u);
        }
        for (std::size_t n = 2; n < 24; ++n) {
            EXPECT_EQ(values[n], static_cast<float>(n % 2 + 10 * (n / 2 % 3) + 100 * (n / 6)));
        }
    }
    EXPECT_TRUE(file.ends_with("\n  </AppendedData>\n</VTKFile>\n"));
    EXPECT_EQ(file.size(), begin + 208 + std::string("\n  </AppendedData>\n</VTKFile>\n").size());
}

TEST(Volume, CellsOutsideAreHidden) {
    const Field volume = places(2, 3, 4);
    Mask inside(volume.layout());
    for (std::int64_t row = 0; row < 12; ++row) inside.row(row)[0] = 1;
    const VolumeArray arrays[] = {{"u", &volume}};
    const std::string file = encode_vti(arrays, {1, 1, 1}, &inside);
    EXPECT_THAT(file, HasSubstr("<DataArray type=\"UInt8\" Name=\"vtkGhostType\" "
                                "format=\"appended\" offset=\"104\"/>"));
    const std::size_t begin = file.find("\n_") + 2 + 104;
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + begin, 8);
    ASSERT_EQ(size, 24u);
    for (std::size_t n = 0; n < 24; ++n) EXPECT_EQ(file[begin + 8 + n], n % 2 == 0 ? 0 : 32);
}

TEST(Volume, ArraysOfThreeDimensionsComeBack) {
    const Field volume = places(5, 3, 4);
    const Result<NpyArray> array = parse_npy(encode_npy(volume));
    ASSERT_TRUE(array) << array.error().message;
    EXPECT_TRUE(fits(*array, Grid{5, 3, {}, 4}));
    EXPECT_FALSE(fits(*array, Grid{5, 12}));
    EXPECT_EQ(cells(to_field(*array)), cells(volume));
}

}  // namespace
}  // namespace cascade
