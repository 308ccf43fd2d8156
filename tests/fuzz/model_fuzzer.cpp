// A fuzzer of the readers of models: the first byte chooses the format, the others are the file.
// The model is made into a surface, whose neighbours are checked. It finds crashes, hangs, leaks
// and inconsistent surfaces. It is built with clang, libFuzzer and sanitizers. README.md in this
// folder has the commands.
#include "core/check.h"
#include "mesh/model_file.h"
#include "tests/support/model_faults.h"
#include "tests/support/small_models.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace cascade {

namespace {

constexpr std::array endings = {"ply", "obj", "off", "stl", "gltf", "glb"};

/// Writes a small valid file of each kind to a folder of inputs.
void write_seeds(const std::filesystem::path& folder) {
    for (const test::SmallModel& model : test::small_models()) {
        const auto format = std::find(endings.begin(), endings.end(), model.ending);
        std::ofstream(folder / model.name, std::ios::binary)
            << static_cast<char>(format - endings.begin()) << model.bytes;
    }
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    for (int k = 1; k < *count; ++k) {
        const std::filesystem::path path = (*arguments)[k];
        if (!std::filesystem::is_directory(path)) continue;
        cascade::write_seeds(path);
        break;
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using cascade::endings;
    if (size == 0) return -1;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    auto soup = cascade::read_model_bytes(bytes, endings[data[0] % endings.size()]);
    if (!soup) {
        CHECK(!soup.error().message.empty(), "a file that is refused has a message");
        return 0;
    }
    CHECK(!cascade::test::fault_of_soup(*soup), "what is read fits together");
    const auto made = cascade::make_mesh(*std::move(soup));
    CHECK(made || !made.error().message.empty(), "a model that is refused has a message");
    if (made) CHECK(!cascade::test::fault_of_mesh(made->mesh), "what is made fits together");
    return 0;
}
