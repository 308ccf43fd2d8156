// Zip archives without compression, as in NumPy's .npz files. The format is "APPNOTE.TXT", PKWARE,
// version 6.3, without encryption and without the extensions for 64 bits.
#pragma once

#include "core/result.h"

#include <span>
#include <string>

namespace cascade {

struct ZipEntry {
    std::string name;  ///< UTF-8, at most 65535 bytes.
    std::string bytes;
};

/// The bytes of the archive. All entries have the earliest time of the format, so that equal
/// entries make equal archives. Fails above 4 GiB and above 65535 entries.
Result<std::string> encode_zip(std::span<const ZipEntry> entries);

}  // namespace cascade
