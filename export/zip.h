// Zip archives of files that are stored as they are: what NumPy's .npz files are. The format:
// "APPNOTE.TXT", PKWARE, version 6.3, without compression, encryption and the extensions for 64
// bits.
#pragma once

#include "core/result.h"

#include <span>
#include <string>

namespace cascade {

struct ZipEntry {
    std::string name;  ///< UTF-8, at most 65535 bytes.
    std::string bytes;
};

/// The archive in memory. The time of its entries is the first one that zip knows, so that equal
/// entries make equal archives. Fails above 4 GiB and above 65535 entries.
Result<std::string> encode_zip(std::span<const ZipEntry> entries);

}  // namespace cascade
