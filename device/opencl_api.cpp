// Loads the loader of OpenCL drivers.
#include "device/opencl_api.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace cascade {
namespace {

Result<OpenclApi> load() {
    void* const library = ::dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        return failure("devices need OpenCL, but its loader libOpenCL.so.1 is missing",
                       "install the package ocl-icd-libopencl1 and the driver of the device");
    }
    OpenclApi api;
    const char* missing = nullptr;
#define CASCADE_LOAD(name)                                                    \
    api.name = reinterpret_cast<decltype(api.name)>(::dlsym(library, #name)); \
    if (api.name == nullptr) missing = #name;
    CASCADE_OPENCL_FUNCTIONS(CASCADE_LOAD)
#undef CASCADE_LOAD
    if (missing != nullptr) {
        return failure(fmt::format("libOpenCL.so.1 lacks {}, a function of OpenCL 1.2", missing),
                       "install a newer one with the package ocl-icd-libopencl1");
    }
    return api;
}

std::string_view name_of(cl_int code) {
    switch (code) {
        case CL_DEVICE_NOT_AVAILABLE: return "the device is not available";
        case CL_MEM_OBJECT_ALLOCATION_FAILURE: return "the device has too little memory";
        case CL_OUT_OF_RESOURCES: return "the device is out of resources or was lost";
        case CL_OUT_OF_HOST_MEMORY: return "the driver has too little memory";
        case CL_BUILD_PROGRAM_FAILURE: return "the driver cannot compile the program";
        case CL_INVALID_BUFFER_SIZE: return "the buffer is too large for the device";
        case CL_INVALID_COMMAND_QUEUE: return "the device was lost";
        default: return "error";
    }
}

}  // namespace

Result<const OpenclApi*> opencl_api() {
    static const Result<OpenclApi> api = load();
    if (!api) return tl::unexpected(api.error());
    return &*api;
}

OpenclError::OpenclError(std::string what_failed, cl_int error_code)
    : message(fmt::format("{} ({} {})", name_of(error_code), what_failed, error_code)),
      code(error_code) {}

void check_opencl(cl_int code, const char* function) {
    if (code != CL_SUCCESS) throw OpenclError(function, code);
}

}  // namespace cascade
