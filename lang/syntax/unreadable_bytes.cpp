// Finds and reports bytes of a source that are not valid text.
#include "lang/syntax/unreadable_bytes.h"

#include "core/utf8.h"

#include <fmt/format.h>

#include <string>

namespace cascade {

bool is_unreadable(std::string_view text, std::size_t offset) {
    return text[offset] == '\0' || !decode_utf8(text, offset).valid;
}

namespace {

/// The message about a run of bytes. Either all bytes of the run are NUL, or none is part of valid
/// UTF-8.
std::string describe_run(std::string_view run) {
    if (run[0] == '\0') {
        return run.size() == 1 ? "a NUL byte (0x00) is not text"
                               : fmt::format("{} NUL bytes (0x00) are not text", run.size());
    }
    constexpr std::size_t most_named = 4;
    std::string bytes;
    for (const char byte : run.substr(0, most_named)) {
        bytes +=
            fmt::format("{}0x{:02x}", bytes.empty() ? "" : " ", static_cast<unsigned char>(byte));
    }
    if (run.size() > most_named) bytes += fmt::format(" and {} more", run.size() - most_named);
    return fmt::format("{} {} {} not valid UTF-8", run.size() == 1 ? "byte" : "bytes", bytes,
                       run.size() == 1 ? "is" : "are");
}

}  // namespace

void report_unreadable_bytes(SourceId source, std::string_view text, Diagnostics& diagnostics) {
    for (std::size_t offset = 0; offset < text.size();) {
        // An ASCII character other than NUL.
        if (static_cast<unsigned char>(text[offset] - 1) < 0x7f) {
            ++offset;
            continue;
        }
        if (!is_unreadable(text, offset)) {
            offset += decode_utf8(text, offset).size;
            continue;
        }
        const std::size_t begin = offset;
        const bool is_nul = text[begin] == '\0';
        while (offset < text.size() && is_unreadable(text, offset) &&
               (text[offset] == '\0') == is_nul) {
            ++offset;
        }
        diagnostics.error({source, static_cast<std::uint32_t>(begin),
                           static_cast<std::uint32_t>(offset)},
                          describe_run(text.substr(begin, offset - begin)),
                          is_nul ? "is this file a script?" : "save the script as UTF-8");
    }
}

}  // namespace cascade
