// A driver of HDF5 whose flushes leave a readable file if the process is killed between two writes.
//
// The library writes parts of a file in the order of their addresses, and the length of the file at
// the end. So for a moment a part may point to a later part that is not yet written. This driver
// gathers the writes of a flush. It writes the length first. Then it writes new parts from the
// highest address down, because a new part points only to later parts. Finally it writes the old
// parts upwards. So if a node of an index is divided, its parent points to both halves before the
// old half becomes shorter.
#pragma once

#include <hdf5.h>

#include <set>

namespace cascade {

/// The identifier of the driver, which is registered at the first call. Negative if that fails.
/// Needs any writable file in order to find the library's own driver, which does the rest.
hid_t hdf5_driver(const char* any_file);

/// Flushes a file that was opened with this driver. `written` holds the addresses of the parts that
/// have been written before. The addresses of new parts are added. Negative if the flush fails.
herr_t flush_in_order(hid_t file, std::set<haddr_t>& written);

/// While an object with `drops` exists, files that this thread closes do not change on the disk.
class DroppedWrites {
public:
    explicit DroppedWrites(bool drops);
    ~DroppedWrites();
    DroppedWrites(const DroppedWrites&) = delete;
    DroppedWrites& operator=(const DroppedWrites&) = delete;
};

}  // namespace cascade
