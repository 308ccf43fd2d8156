// A fuzzer of the readers of the program's own cache files, which hold cells of a model or a
// compiled kernel. The first byte chooses the reader and whether the checksum is corrected. With a
// correct checksum, the data is read, too.
#include "core/check.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "jit/code_cache.h"
#include "mesh/make_mesh.h"
#include "mesh/model_file.h"
#include "surface/cell_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/small_models.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cascade {

namespace {

constexpr int mend_checksum = 2;  // If set in the first byte, the checksum is corrected.

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Cells of a small torus, and their cache file.
class Cells {
public:
    Cells() {
        auto soup = read_model_bytes(test::small_torus_obj(), "obj");
        CHECK(soup, "the torus can be read");
        mesh_ = make_mesh(*std::move(soup)).value().mesh;
        options_.count = 40;
        key_ = key_of(mesh_, options_);
        Team team(1);
        std::atomic<bool> cancel{false};
        CHECK(kept_cells(path_, mesh_, options_, team, cancel), "the torus has cells");
        bytes_ = content_of(path_);
    }
    const std::string& bytes() const { return bytes_; }

    void read(std::string bytes, bool is_mended) {
        if (is_mended && bytes.size() >= 8) {
            const std::uint64_t sum = fnv1a(std::string_view(bytes).substr(0, bytes.size() - 8));
            std::memcpy(bytes.data() + bytes.size() - 8, &sum, 8);
        }
        fuzz::write_bytes(path_, bytes);
        const auto cells = read_cells(path_, mesh_, key_);
        CHECK(cells || !cells.error().message.empty(), "cells that are refused have a message");
    }

private:
    fuzz::ScratchFolder folder_;
    std::filesystem::path path_ = folder_.path() / "cells";
    SurfaceMesh mesh_;
    CellOptions options_;
    CellKey key_;
    std::string bytes_;
};

/// A compiled kernel and its cache file.
class Kernel {
public:
    Kernel() {
        std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_all);
        cache_.keep(key, CodeImage{std::string(100, '\x90'), 16});
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) path_ = entry;
        bytes_ = content_of(path_);
        CHECK(!bytes_.empty() && cache_.find(key), "a kernel is kept");
    }
    const std::string& bytes() const { return bytes_; }

    void read(std::string bytes, bool is_mended) {
        constexpr std::size_t begin =
            16;  // Where the data that the checksum protects begins, see core/kept_files.cpp.
        if (is_mended && bytes.size() >= begin) {
            const std::uint64_t sum = fnv1a(std::string_view(bytes).substr(begin));
            std::memcpy(bytes.data() + 8, &sum, 8);
        }
        fuzz::write_bytes(path_, bytes);
        const auto image = cache_.find(key);
        if (image) CHECK(image->entry < image->bytes.size(), "a kernel begins inside itself");
    }

private:
    static constexpr std::string_view key = "a kernel";
    fuzz::ScratchFolder folder_;
    CodeCache cache_{folder_.path()};
    std::filesystem::path path_;
    std::string bytes_;
};

Cells& cells() {
    static Cells all;
    return all;
}
Kernel& kernel() {
    static Kernel one;
    return one;
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    cascade::fuzz::write_seeds(*count, *arguments,
                               {{"cells", 0, cascade::cells().bytes()},
                                {"kernel", 1, cascade::kernel().bytes()},
                                {"mended_cells", cascade::mend_checksum, cascade::cells().bytes()},
                                {"mended_kernel", cascade::mend_checksum + 1,
                                 cascade::kernel().bytes()}});
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return -1;
    std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const bool is_mended = (data[0] & cascade::mend_checksum) != 0;
    if (data[0] % 2 == 0) cascade::cells().read(std::move(bytes), is_mended);
    else cascade::kernel().read(std::move(bytes), is_mended);
    return 0;
}
