// The file of a kernel contains the offset of the kernel's function (CodeImage::entry) as a word,
// followed by the bytes of the image.
#include "jit/code_cache.h"

#include <cstring>
#include <string>

namespace cascade {

std::optional<CodeImage> CodeCache::find(std::string_view key) const {
    const auto content = files_.find(key);
    std::uint64_t entry = 0;
    if (!content || content->size() < sizeof entry) return std::nullopt;
    std::memcpy(&entry, content->data(), sizeof entry);
    if (entry >= content->size() - sizeof entry) return std::nullopt;
    return CodeImage{content->substr(sizeof entry), entry};
}

void CodeCache::keep(std::string_view key, const CodeImage& image) {
    const std::uint64_t entry = image.entry;
    std::string content(sizeof entry, '\0');
    std::memcpy(content.data(), &entry, sizeof entry);
    files_.keep(key, content += image.bytes);
}

}  // namespace cascade
