// Drawings as PDF files, whose streams are decompressed by zlib.
#include "picture/drawing.h"

#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The decompressed streams of a file, one after another.
std::string streams_of(const std::string& file) {
    std::string all;
    for (std::size_t at = 0; (at = file.find("stream\r\n", at)) != std::string::npos;) {
        const std::size_t begin = at + 8, end = file.find("endstream", begin);
        std::string unpacked(1 << 20, '\0');
        uLongf size = unpacked.size();
        if (uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &size,
                       reinterpret_cast<const Bytef*>(file.data() + begin),
                       static_cast<uLong>(end - begin)) == Z_OK) {
            all += unpacked.substr(0, size) + "\n";
        }
        at = end + 9;
    }
    return all;
}

std::string drawn(Drawing drawing) {
    const auto pdf = as_pdf(drawing);
    EXPECT_TRUE(pdf) << pdf.error().message;
    if (!pdf) return "";
    EXPECT_TRUE(pdf->starts_with("%PDF-"));
    EXPECT_THAT(*pdf, HasSubstr("%%EOF"));
    return streams_of(*pdf);
}

TEST(DrawingPdf, HasAreasLinesAndDiscsInPoints) {
    Drawing drawing{200, 100, {}};
    drawing.add(DrawnArea{{20, 10}, 40, 20, {1, 0, 0}});
    drawing.add(DrawnLine{{{0, 0}, {100, 100}}, {0, 0, 1}, 2, true});
    drawing.add(DrawnDisc{{50, 50}, 4, {0, 1, 0}});
    const std::string page = drawn(drawing);
    // In PDF, a unit of the drawing is 3/4 point, and y points upwards.
    EXPECT_THAT(page, HasSubstr("1 0 0 rg\n15 52.5 30 15 re\nf"));
    EXPECT_THAT(page, HasSubstr("[4 3 ] 0 d"));
    EXPECT_THAT(page, HasSubstr("75 0 l\nS"));
    EXPECT_THAT(page, HasSubstr("0 1 0 rg"));
}

TEST(DrawingPdf, SetsTextsInLatinAndGreek) {
    Drawing drawing{300, 100, {}};
    drawing.add(DrawnText{{10, 20}, "D = 5 µm², α − Ω (漢)", DrawnText::Anchor::end});
    const auto pdf = as_pdf(drawing);
    ASSERT_TRUE(pdf);
    EXPECT_THAT(*pdf, HasSubstr("/BaseFont /Helvetica"));
    EXPECT_THAT(*pdf, HasSubstr("/BaseFont /Symbol"));
    const std::string page = streams_of(*pdf);
    EXPECT_THAT(page, HasSubstr("D = 5"));
    EXPECT_THAT(page, HasSubstr("(a) Tj"));
    EXPECT_THAT(page, HasSubstr("(W) Tj"));
    EXPECT_THAT(page, HasSubstr("?"));
}

TEST(DrawingPdf, HasThePixelsOfImages) {
    Drawing drawing{100, 100, {}};
    Image image(2, 1);
    image.at(0, 0) = {1, 0, 0};
    image.at(1, 0) = {0, 0.5F, 1};
    drawing.add(DrawnImage{{10, 10}, 80, 40, image});
    EXPECT_THAT(drawn(drawing), HasSubstr(std::string("\xff\x00\x00\x00\x80\xff", 6)));
}

TEST(DrawingPdf, IsTheSameEachTime) {
    Drawing drawing{100, 100, {}};
    drawing.add(DrawnText{{10, 20}, "again", DrawnText::Anchor::start});
    EXPECT_EQ(*as_pdf(drawing), *as_pdf(drawing));
}

TEST(DrawingPdf, RefusesPagesBeyondTheFormat) {
    const auto pdf = as_pdf(Drawing{30000, 100, {}});
    ASSERT_FALSE(pdf);
    EXPECT_THAT(pdf.error().message, HasSubstr("does not fit into a PDF file"));
}

}  // namespace
}  // namespace cascade
