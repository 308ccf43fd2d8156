// All entries have the same date, so that equal cells give equal bytes.
#include "export/zip.h"

#include "picture/float_bytes.h"

#include <libdeflate.h>

#include <cstdint>
#include <limits>

namespace cascade {

namespace {

constexpr std::uint16_t version_needed = 20;
constexpr std::uint16_t names_are_utf8 = 1 << 11;
constexpr std::uint16_t first_date = (1 << 5) | 1;  // 1 January 1980.

void append16(std::string& bytes, std::size_t number) {
    append_number(bytes, static_cast<std::uint16_t>(number));
}
void append32(std::string& bytes, std::size_t number) {
    append_number(bytes, static_cast<std::uint32_t>(number));
}

/// The description of an entry, which is written both before the entry and in the directory at the
/// end.
std::string description_of(const ZipEntry& entry) {
    const std::size_t checksum = libdeflate_crc32(0, entry.bytes.data(), entry.bytes.size());
    std::string bytes;
    append16(bytes, version_needed);
    append16(bytes, names_are_utf8);
    append16(bytes, 0);  // Method: no compression.
    append16(bytes, 0);  // Time: midnight.
    append16(bytes, first_date);
    append32(bytes, checksum);
    append32(bytes, entry.bytes.size());
    append32(bytes, entry.bytes.size());
    append16(bytes, entry.name.size());
    append16(bytes, 0);  // Length of the extra field.
    return bytes;
}

std::string directory_entry(const ZipEntry& entry, std::size_t begin) {
    std::string bytes = "PK\x01\x02";
    append16(bytes, version_needed);
    bytes += description_of(entry);
    append16(bytes, 0);  // Length of the comment.
    append16(bytes, 0);  // Number of the disk.
    append16(bytes, 0);  // Content: bytes, not text.
    append32(bytes, 0);  // Attributes of the file.
    append32(bytes, begin);
    return bytes + entry.name;
}

}  // namespace

Result<std::string> encode_zip(std::span<const ZipEntry> entries) {
    constexpr std::size_t most_entries = std::numeric_limits<std::uint16_t>::max();
    constexpr std::size_t head = 30, directory_head = 46, end = 22;
    if (entries.size() > most_entries) return failure("the archive has too many entries");
    std::size_t size = end;
    for (const ZipEntry& entry : entries) {
        size += head + directory_head + 2 * entry.name.size() + entry.bytes.size();
        if (entry.name.size() > most_entries) return failure("the name of an entry is too long");
        if (size > std::numeric_limits<std::uint32_t>::max()) {
            return failure("a zip archive holds at most 4 GiB");
        }
    }
    std::string bytes, directory;
    bytes.reserve(size);
    for (const ZipEntry& entry : entries) {
        directory += directory_entry(entry, bytes.size());
        bytes += "PK\x03\x04";
        bytes += description_of(entry) + entry.name;
        bytes += entry.bytes;
    }
    const std::size_t directory_begin = bytes.size();
    bytes += directory + "PK\x05\x06";
    append32(bytes, 0);  // Numbers of this disk and of the first disk.
    append16(bytes, entries.size());
    append16(bytes, entries.size());
    append32(bytes, directory.size());
    append32(bytes, directory_begin);
    append16(bytes, 0);  // Length of the comment.
    return bytes;
}

}  // namespace cascade
