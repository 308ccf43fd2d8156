// Loads the module that uses OpenVDB.
#include "picture/vdb.h"

#include "core/version.h"
#include "core/write_encoded.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

namespace cascade {

namespace {

constexpr const char* without_it = "use --volume NAME.vti, which needs no OpenVDB";

#ifdef CASCADE_OPENVDB_MODULE
/// Whether OpenVDB's libraries and the stacks of their threads fit into the address space. If one
/// of the libraries cannot start its threads, it ends the program or waits for ever.
bool has_room_for_libraries() {
    constexpr std::size_t room = std::size_t{192} << 20;
    void* const pages = ::mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return false;
    ::munmap(pages, room);
    return true;
}
#endif

Result<VdbEncoder*> load_encoder() {
#ifdef CASCADE_OPENVDB_MODULE
    if (!has_room_for_libraries()) {
        return failure("there is not enough memory to load OpenVDB", without_it);
    }
    // The module is never unloaded, because threads of OpenVDB's libraries may still run.
    void* const module = ::dlopen(CASCADE_OPENVDB_MODULE, RTLD_LAZY | RTLD_LOCAL);
    if (!module) {
        const char* reason = ::dlerror();
        return failure(fmt::format("OpenVDB could not be loaded: {}",
                                   reason ? reason : "unknown reason"),
                       without_it);
    }
    const auto entry = reinterpret_cast<VdbEncoderEntry*>(::dlsym(module, vdb_encoder_symbol));
    VdbEncoder* const encoder = entry ? entry(version()) : nullptr;
    if (encoder) return encoder;
    return failure(fmt::format("{} belongs to another build of this program",
                               CASCADE_OPENVDB_MODULE),
                   "install this program and its modules again");
#else
    return failure("this build has no OpenVDB",
                   fmt::format("install libopenvdb-dev and build Cascade again; {}", without_it));
#endif
}

const Result<VdbEncoder*>& encoder() {
    static const Result<VdbEncoder*> loaded = load_encoder();
    return loaded;
}

}  // namespace

Result<void> check_vdb(const std::filesystem::path& path) {
    if (encoder()) return {};
    const Failure& reason = encoder().error();
    return failure(fmt::format("cannot write '{}': {}", path.string(), reason.message),
                   reason.hint);
}

Result<void> write_vdb(const std::filesystem::path& path, const VdbVolume& volume) {
    if (auto can = check_vdb(path); !can) return can;
    return write_encoded(path, [&] { return (*encoder())(volume); });
}

}  // namespace cascade
