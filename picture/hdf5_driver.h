// A driver of HDF5 whose flushes leave a readable file if the process is killed between two writes.
//
// The library writes parts of a file in the order of their addresses, and the length of the file at
// the end. So for a moment a part may point to a later part that is not yet written. This driver
// gathers the writes of a flush. It writes the length first. Then it writes new parts from the
// highest address down, because a new part points only to later parts. Finally it writes the old
// parts in ascending order. So if a node of an index is divided, its parent points to both halves
// before the old half becomes shorter.
#pragma once

#include <hdf5.h>

#include <set>

namespace cascade {

/// Registers the driver at the first call, and returns its identifier. Negative if the driver
/// cannot be registered. `any_file` must be a writable file. It is needed to find the library's own
/// driver, which does the rest of the work.
hid_t hdf5_driver(const char* any_file);

/// Flushes a file that was opened with this driver. `written` holds the addresses of the parts that
/// earlier flushes have written. The addresses of new parts are added. Negative if the flush fails.
herr_t flush_in_order(hid_t file, std::set<haddr_t>& written);

/// While an object made with `drops` = true exists, files that this thread closes do not change on
/// the disk.
class DroppedWrites {
public:
    explicit DroppedWrites(bool drops);
    ~DroppedWrites();
    DroppedWrites(const DroppedWrites&) = delete;
    DroppedWrites& operator=(const DroppedWrites&) = delete;
};

}  // namespace cascade
