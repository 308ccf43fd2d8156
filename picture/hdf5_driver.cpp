// The driver is a copy of the library's driver for files (sec2), but has another function for
// writing.
#include "picture/hdf5_driver.h"

#include <map>
#include <vector>

namespace cascade {

namespace {

struct PendingWrite {
    H5FD_mem_t kind;
    std::vector<char> bytes;
};

/// The gathered writes, by address, of the flush that runs on this thread.
struct GatheredWrites {
    bool is_gathering = false;
    H5FD_t* file = nullptr;
    hid_t transfer = -1;
    std::map<haddr_t, PendingWrite> writes;
};

thread_local GatheredWrites gathered;
thread_local bool drops_writes = false;
const H5FD_class_t* files_of_library = nullptr;

herr_t write_gathered(H5FD_t* file, H5FD_mem_t kind, hid_t transfer, haddr_t address,
                      std::size_t size, const void* bytes) {
    if (drops_writes) return 0;
    if (!gathered.is_gathering || kind == H5FD_MEM_DRAW) {
        return files_of_library->write(file, kind, transfer, address, size, bytes);
    }
    gathered.file = file;
    gathered.transfer = transfer;
    const char* const begin = static_cast<const char*>(bytes);
    gathered.writes.insert_or_assign(address, PendingWrite{kind, {begin, begin + size}});
    return 0;
}

herr_t write_one(haddr_t address, const PendingWrite& one) {
    return files_of_library->write(gathered.file, one.kind, gathered.transfer, address,
                                   one.bytes.size(), one.bytes.data());
}

/// Keeps the library from joining adjacent parts of the file.
herr_t features_without_joining(const H5FD_t* file, unsigned long* flags) {
    const herr_t result = files_of_library->query(file, flags);
    if (flags) *flags &= ~static_cast<unsigned long>(H5FD_FEAT_ACCUMULATE_METADATA);
    return result;
}

herr_t truncate_unless_dropped(H5FD_t* file, hid_t transfer, hbool_t closing) {
    return drops_writes ? 0 : files_of_library->truncate(file, transfer, closing);
}

/// Performs the gathered writes.
herr_t write_in_order(std::set<haddr_t>& written) {
    auto& writes = gathered.writes;
    if (writes.empty()) return 0;
    if (files_of_library->truncate(gathered.file, gathered.transfer, false) < 0) return -1;
    if (const auto head = writes.find(0); head != writes.end()) {
        if (write_one(0, head->second) < 0) return -1;
        writes.erase(head);
    }
    for (auto at = writes.rbegin(); at != writes.rend(); ++at) {
        if (written.contains(at->first)) continue;
        if (write_one(at->first, at->second) < 0) return -1;
    }
    for (const auto& [address, one] : writes) {
        if (!written.insert(address).second && write_one(address, one) < 0) return -1;
    }
    return 0;
}

}  // namespace

hid_t hdf5_driver(const char* any_file) {
    static const hid_t driver = [&]() -> hid_t {
        const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
        H5FD_t* const file = H5FDopen(any_file, H5F_ACC_RDWR | H5F_ACC_CREAT, access, HADDR_UNDEF);
        H5Pclose(access);
        if (!file) return -1;
        files_of_library = file->cls;
        static H5FD_class_t own = *file->cls;
        own.name = "cascade";
        own.query = features_without_joining;
        own.write = write_gathered;
        own.truncate = truncate_unless_dropped;
        own.terminate = nullptr;
        H5FDclose(file);
        return H5FDregister(&own);
    }();
    return driver;
}

herr_t flush_in_order(hid_t file, std::set<haddr_t>& written) {
    gathered.is_gathering = true;
    herr_t result = H5Fflush(file, H5F_SCOPE_LOCAL);
    gathered.is_gathering = false;
    if (write_in_order(written) < 0) result = -1;
    gathered.writes.clear();
    return result;
}

DroppedWrites::DroppedWrites(bool drops) { drops_writes = drops; }

DroppedWrites::~DroppedWrites() { drops_writes = false; }

}  // namespace cascade
