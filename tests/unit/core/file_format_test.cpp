// The table of formats, and lists of endings in messages.
#include "core/file_format.h"

#include <gtest/gtest.h>

#include <array>

namespace cascade {
namespace {

TEST(FileFormats, are_in_the_order_of_their_numbers_and_each_has_an_ending_of_its_own) {
    for (std::size_t k = 0; k < file_formats.size(); ++k) {
        EXPECT_EQ(static_cast<std::size_t>(file_formats[k].format), k);
        const auto path = "a" + std::string(file_formats[k].ending);
        EXPECT_EQ(find_format(path), &file_formats[k]) << path;
    }
    EXPECT_TRUE(is_of_format("a/b.GIF", FileFormat::gif));
    EXPECT_TRUE(is_of_format("a.Cells.VTP", FileFormat::cells_vtp));
    EXPECT_TRUE(is_of_format("cells.vtp", FileFormat::vtp));
    EXPECT_EQ(find_format("gif"), nullptr);
    EXPECT_EQ(find_format(""), nullptr);
}

TEST(FileFormats, are_listed_in_words) {
    EXPECT_EQ(endings_of(FormatKind::picture, "or"), ".png");
    EXPECT_EQ(endings_of(FormatKind::figure, "or"), ".svg or .pdf");
    EXPECT_EQ(endings_of(FormatKind::film), ".gif, .webp, .apng, .mp4, .webm");
    EXPECT_EQ(endings_of(FormatTrait::texture, "and"), ".ply, .obj and .glb");
    EXPECT_EQ(output_of(FormatTrait::maps), "-o NAME.glb");
}

struct Writer {
    FileFormat format;
};
constexpr std::array one_figure = {Writer{FileFormat::svg}};
constexpr std::array figures = {Writer{FileFormat::svg}, Writer{FileFormat::pdf}};
static_assert(!has_all_of(one_figure, FormatKind::figure));
static_assert(has_all_of(figures, FormatKind::figure));

}  // namespace
}  // namespace cascade
