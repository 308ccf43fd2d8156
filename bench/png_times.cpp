// cascade_png_times: the time from the values of a picture to the bytes of its file, compared with
// libpng and zlib. Files are written as frames (fast) and as pictures that are kept (small).
//
// All flags of Google Benchmark work. The counter `size` is the size of the file.
#include "picture/image.h"

#include <benchmark/benchmark.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

/// A field of bent stripes, like a pattern.
Field pattern(std::int64_t size) {
    Field field{PlaneLayout(Grid{size, size})};
    for (std::int64_t j = 0; j < size; ++j) {
        for (std::int64_t i = 0; i < size; ++i) {
            const double x = static_cast<double>(i) / 9, y = static_cast<double>(j) / 9;
            const double wave = x * std::cos(y / 17) + 3 * std::sin(y / 5) + std::sin(x / 3 + y);
            field.at(i, j) = static_cast<float>(std::tanh(0.8 * std::sin(wave)));
        }
    }
    return field;
}

Image picture(const benchmark::State& state, const char* palette) {
    return paint(pattern(state.range(0)), {-1, 1}, *find_palette(palette));
}

void count(benchmark::State& state, std::size_t file_size) {
    state.counters["size"] = static_cast<double>(file_size);
    state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
}

void painting(benchmark::State& state) {
    const Field field = pattern(state.range(0));
    const Palette& palette = *find_palette("leopard");
    for (auto turn : state) {
        Image image = paint(field, {-1, 1}, palette);
        benchmark::DoNotOptimize(image.pixels.data());
    }
    count(state, 0);
}

void ours(benchmark::State& state, const char* palette, PngDepth depth, PngEffort effort) {
    const Image image = picture(state, palette);
    std::size_t size = 0;
    for (auto turn : state) {
        size = encode_png(image, depth, {}, PngMeaning::colours, effort)->size();
    }
    count(state, size);
}

void append(png_structp png, png_bytep data, png_size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

/// libpng with samples of 8 bits. A fast file has no filters and zlib's level 1.
std::size_t write_by_libpng(const std::vector<png_byte>& samples, png_uint_32 size, int channels,
                            PngEffort effort) {
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, size, size, 8, channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (effort == PngEffort::fast) {
        png_set_compression_level(png, 1);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    }
    png_write_info(png, info);
    for (std::size_t row = 0; row < samples.size(); row += size * static_cast<unsigned>(channels)) {
        png_write_row(png, &samples[row]);
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return file.size();
}

/// The case of libpng, which gets samples.
void libpng(benchmark::State& state, const char* palette, PngEffort effort) {
    const int channels = palette == std::string("grey") ? 1 : 3;
    std::vector<png_byte> samples;
    for (const Colour& pixel : picture(state, palette).pixels) {
        for (int c = 0; c < channels; ++c) {
            samples.push_back(static_cast<png_byte>(
                std::lround(255 * static_cast<double>(pixel[static_cast<std::size_t>(c)]))));
        }
    }
    std::size_t size = 0;
    for (auto turn : state) {
        size = write_by_libpng(samples, static_cast<png_uint_32>(state.range(0)), channels, effort);
    }
    count(state, size);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(1024)->Unit(benchmark::kMillisecond);
}

BENCHMARK(painting)->Apply(sizes);
BENCHMARK_CAPTURE(ours, fast_grey, "grey", PngDepth::eight, PngEffort::fast)->Apply(sizes);
BENCHMARK_CAPTURE(libpng, fast_grey, "grey", PngEffort::fast)->Apply(sizes);
BENCHMARK_CAPTURE(ours, fast_colour, "leopard", PngDepth::eight, PngEffort::fast)->Apply(sizes);
BENCHMARK_CAPTURE(libpng, fast_colour, "leopard", PngEffort::fast)->Apply(sizes);
BENCHMARK_CAPTURE(ours, small_grey, "grey", PngDepth::eight, PngEffort::small)->Apply(sizes);
BENCHMARK_CAPTURE(libpng, small_grey, "grey", PngEffort::small)->Apply(sizes);
BENCHMARK_CAPTURE(ours, small_colour, "leopard", PngDepth::eight, PngEffort::small)->Apply(sizes);
BENCHMARK_CAPTURE(libpng, small_colour, "leopard", PngEffort::small)->Apply(sizes);
BENCHMARK_CAPTURE(ours, small_16_bit, "leopard", PngDepth::sixteen, PngEffort::small)->Apply(sizes);

}  // namespace
}  // namespace cascade::bench

BENCHMARK_MAIN();
