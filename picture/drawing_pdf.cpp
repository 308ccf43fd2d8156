// Writes a drawing as PDF with libharu: one page, with texts in the fonts that every reader has.
#include "core/utf8.h"
#include "picture/drawing.h"

#include <hpdf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>

namespace cascade {

namespace {

constexpr double points_per_unit = 0.75;  // As in SVG, 96 units are an inch, which is 72 points.
constexpr double text_size = 13 * points_per_unit;
constexpr Colour text_ink{0.16F, 0.16F, 0.17F};
constexpr char unknown = '?';

/// A part of a text that is in one font.
struct Run {
    bool is_greek = false;
    std::string bytes;
};

/// The code of a Greek letter in the font Symbol; 0 if the font lacks the letter.
char in_symbol(char32_t letter) {
    // The letters of Symbol in the order of Unicode, from α and Α. A blank marks a letter without a
    // code or without a glyph.
    constexpr std::string_view small = "abgdezhqiklmnxoprVstufcyw",
                               large = "ABGDEZHQIKLMNXOPR STUFCYW";
    if (letter >= U'α' && letter < U'α' + small.size()) return small[letter - U'α'];
    if (letter >= U'Α' && letter < U'Α' + large.size()) {
        const char found = large[letter - U'Α'];
        return found == ' ' ? '\0' : found;
    }
    return '\0';
}

/// Divides a text into runs and encodes each run for its font. The encodings are WinAnsiEncoding,
/// which is Latin-1 except for some signs, and the own encoding of Symbol.
std::vector<Run> runs_of(std::string_view text) {
    std::vector<Run> runs;
    const auto add = [&](bool is_greek, char byte) {
        if (runs.empty() || runs.back().is_greek != is_greek) runs.push_back({is_greek, {}});
        runs.back().bytes += byte;
    };
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint read = decode_utf8(text, at);
        const char32_t letter = read.value;
        at += read.size;
        const char greek = in_symbol(letter);
        const bool is_latin =
            (letter >= 0x20 && letter < 0x7f) || (letter >= 0xa0 && letter <= 0xff);
        if (greek != '\0') add(true, greek);
        else if (letter == U'−') add(false, '-');
        else if (letter == U'…') add(false, '\x85');
        else add(false, is_latin ? static_cast<char>(letter) : unknown);
    }
    return runs;
}

class Page {
public:
    explicit Page(const Drawing& drawing) : pdf_(HPDF_New(nullptr, nullptr)) {
        if (!pdf_) return;
        HPDF_SetCompressionMode(pdf_.get(), HPDF_COMP_ALL);
        page_ = HPDF_AddPage(pdf_.get());
        latin_ = HPDF_GetFont(pdf_.get(), "Helvetica", "WinAnsiEncoding");
        greek_ = HPDF_GetFont(pdf_.get(), "Symbol", nullptr);
        HPDF_Page_SetWidth(page_, number(drawing.width));
        HPDF_Page_SetHeight(page_, number(drawing.height));
        height_ = drawing.height;
        for (const auto& shape : drawing.shapes) {
            std::visit([&](const auto& each) { add(each); }, shape);
        }
    }

    Result<std::string> bytes() {
        if (!pdf_) return failure("there is not enough memory for the PDF file");
        HPDF_SaveToStream(pdf_.get());
        std::string bytes(HPDF_GetStreamSize(pdf_.get()), '\0');
        auto size = static_cast<HPDF_UINT32>(bytes.size());
        HPDF_ReadFromStream(pdf_.get(), reinterpret_cast<HPDF_BYTE*>(bytes.data()), &size);
        if (HPDF_GetError(pdf_.get()) != HPDF_OK || size != bytes.size()) {
            return failure("the drawing does not fit into a PDF file",
                           "a page is at most 14,400 points wide and high");
        }
        return bytes;
    }

private:
    struct Free {
        void operator()(HPDF_Doc pdf) const { HPDF_Free(pdf); }
    };

    static HPDF_REAL number(double units) {
        return static_cast<HPDF_REAL>(units * points_per_unit);
    }
    HPDF_REAL x(const DrawnPoint& point) const { return number(point[0]); }
    HPDF_REAL y(const DrawnPoint& point) const { return number(height_ - point[1]); }
    void fill_with(const Colour& colour) {
        HPDF_Page_SetRGBFill(page_, part(colour[0]), part(colour[1]), part(colour[2]));
    }
    static HPDF_REAL part(float value) { return std::clamp(value, 0.0F, 1.0F); }

    void add(const DrawnLine& line) {
        if (line.points.size() < 2) return;
        HPDF_Page_SetRGBStroke(page_, part(line.colour[0]), part(line.colour[1]),
                               part(line.colour[2]));
        HPDF_Page_SetLineWidth(page_, number(line.width));
        const HPDF_UINT16 dashes[] = {4, 3};
        HPDF_Page_SetDash(page_, line.dashed ? dashes : nullptr, line.dashed ? 2 : 0, 0);
        HPDF_Page_MoveTo(page_, x(line.points[0]), y(line.points[0]));
        for (std::size_t k = 1; k < line.points.size(); ++k) {
            HPDF_Page_LineTo(page_, x(line.points[k]), y(line.points[k]));
        }
        HPDF_Page_Stroke(page_);
    }

    void add(const DrawnArea& area) {
        fill_with(area.colour);
        HPDF_Page_Rectangle(page_, x(area.corner), y({0, area.corner[1] + area.height}),
                            number(area.width), number(area.height));
        HPDF_Page_Fill(page_);
    }

    void add(const DrawnDisc& disc) {
        fill_with(disc.colour);
        HPDF_Page_Circle(page_, x(disc.centre), y(disc.centre), number(disc.radius));
        HPDF_Page_Fill(page_);
    }

    void add(const DrawnText& text) {
        const std::vector<Run> runs = runs_of(text.text);
        HPDF_REAL width = 0;
        for (const Run& run : runs) {
            HPDF_Page_SetFontAndSize(page_, run.is_greek ? greek_ : latin_, text_size);
            width += HPDF_Page_TextWidth(page_, run.bytes.c_str());
        }
        const HPDF_REAL before = text.anchor == DrawnText::Anchor::start    ? 0
                                 : text.anchor == DrawnText::Anchor::middle ? width / 2
                                                                            : width;
        fill_with(text_ink);
        HPDF_Page_BeginText(page_);
        HPDF_Page_MoveTextPos(page_, x(text.place) - before, y(text.place) - number(4.5));
        for (const Run& run : runs) {
            HPDF_Page_SetFontAndSize(page_, run.is_greek ? greek_ : latin_, text_size);
            HPDF_Page_ShowText(page_, run.bytes.c_str());
        }
        HPDF_Page_EndText(page_);
    }

    /// Draws an image on white, the colour of the page. Readers do not interpolate the image, by
    /// the format's default.
    void add(const DrawnImage& drawn) {
        const Image& image = drawn.image;
        std::vector<HPDF_BYTE> levels;
        for (std::int64_t y = 0; y < image.height; ++y) {
            for (std::int64_t x = 0; x < image.width; ++x) {
                for (const float value : image.over(pure_white, x, y)) {
                    levels.push_back(static_cast<HPDF_BYTE>(std::lround(255 * part(value))));
                }
            }
        }
        const HPDF_Image made =
            HPDF_LoadRawImageFromMem(pdf_.get(), levels.data(), static_cast<HPDF_UINT>(image.width),
                                     static_cast<HPDF_UINT>(image.height), HPDF_CS_DEVICE_RGB, 8);
        if (made == nullptr) return;  // The document itself records the error.
        HPDF_Page_DrawImage(page_, made, x(drawn.corner), y({0, drawn.corner[1] + drawn.height}),
                            number(drawn.width), number(drawn.height));
    }

    std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, Free> pdf_;
    HPDF_Page page_ = nullptr;
    HPDF_Font latin_ = nullptr, greek_ = nullptr;
    double height_ = 0;
};

}  // namespace

Result<std::string> as_pdf(const Drawing& drawing) { return Page(drawing).bytes(); }

}  // namespace cascade
