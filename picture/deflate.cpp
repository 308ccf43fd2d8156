// Compresses with libdeflate.
#include "picture/deflate.h"

#include "core/enough_memory.h"

#include <libdeflate.h>

#include <memory>

namespace cascade {

std::string deflated(std::string_view bytes, int level) {
    const auto free = [](libdeflate_compressor* made) { libdeflate_free_compressor(made); };
    const std::unique_ptr<libdeflate_compressor, decltype(free)> compressor(
        libdeflate_alloc_compressor(level), free);
    if (!compressor) lack_memory();
    const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), bytes.size());
    const auto buffer = std::make_unique_for_overwrite<char[]>(most);
    const std::size_t used =
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), buffer.get(), most);
    return {buffer.get(), used};
}

std::uint32_t crc32_of(std::string_view bytes) {
    return libdeflate_crc32(0, bytes.data(), bytes.size());
}

}  // namespace cascade
