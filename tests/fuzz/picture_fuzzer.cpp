// A fuzzer of the readers of pictures and arrays: the first byte chooses the reader, the others are
// the file. saved_run_fuzzer.cpp passes the texts of pictures to their readers in run/.
#include "core/check.h"
#include "picture/grey_picture.h"
#include "picture/image.h"
#include "picture/npy.h"
#include "tests/fuzz/seeds.h"

#include <cstddef>
#include <cstdint>

namespace cascade {

namespace {

constexpr char readers = 4;

template <typename T>
bool has_reason(const Result<T>& result) {
    return result || !result.error().message.empty();
}

void read_array(std::string_view bytes, Precision precision) {
    const auto array = parse_npy(bytes, precision);
    CHECK(has_reason(array), "an array that is refused has a message");
    if (!array) return;
    const auto cells = array->slices * array->rows * array->columns;
    CHECK(cells == static_cast<std::int64_t>(array->values.size()), "an array has all its values");
    if (cells < 4096) encode_npy(to_field(*array, precision));
}

void read(char reader, std::string_view bytes) {
    switch (reader) {
        case 0: {
            const auto picture = parse_grey_picture(bytes);
            CHECK(has_reason(picture), "a picture that is refused has a message");
            break;
        }
        case 1: {
            const auto texts = parse_png_texts(bytes);
            CHECK(has_reason(texts), "a picture that is refused has a message");
            break;
        }
        case 2: return read_array(bytes, Precision::single);
        default: return read_array(bytes, Precision::binary64);
    }
}

std::vector<fuzz::Seed> seeds() {
    std::vector<fuzz::Seed> all;
    Image image(5, 3);
    const PngTexts texts = {{"Cascade script", "stage s: turing_spots { }"},
                            {"Software", "Cascade"}};
    for (const PngDepth depth : {PngDepth::eight, PngDepth::sixteen}) {
        const std::string bytes = encode_png(image, depth, texts).value();
        const std::string name = depth == PngDepth::eight ? "8" : "16";
        all.push_back({"grey" + name, 0, bytes});
        all.push_back({"texts" + name, 1, bytes});
    }
    const Field flat(PlaneLayout(Grid{4, 3}));
    const Field deep(PlaneLayout(Grid{3, 2, {}, 2}), Precision::binary64);
    all.push_back({"plane", 2, encode_npy(flat)});
    all.push_back({"volume", 3, encode_npy(deep)});
    for (const char* type : {"<i2", ">u4", "|b1", ">f8", "<i8", "|u1"}) {
        all.push_back({std::string("array_") + type[1] + type[2], 2,
                       npy_head(type, "2, 3") + std::string(48, '\1')});
    }
    return all;
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    cascade::fuzz::write_seeds(*count, *arguments, cascade::seeds());
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return -1;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    cascade::read(static_cast<char>(data[0] % cascade::readers), bytes);
    return 0;
}
