// Calls OpenCL.
#include "device/opencl_device.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {
namespace {

std::string text_of(const OpenclApi& api, cl_device_id device, cl_device_info what) {
    std::size_t size = 0;
    check_opencl(api.clGetDeviceInfo(device, what, 0, nullptr, &size), "clGetDeviceInfo");
    std::string text(size, '\0');
    check_opencl(api.clGetDeviceInfo(device, what, size, text.data(), nullptr), "clGetDeviceInfo");
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

template <typename Value>
Value value_of(const OpenclApi& api, cl_device_id device, cl_device_info what) {
    Value value{};
    check_opencl(api.clGetDeviceInfo(device, what, sizeof value, &value, nullptr),
                 "clGetDeviceInfo");
    return value;
}

DeviceFacts facts_of(const OpenclApi& api, cl_platform_id platform, cl_device_id device) {
    DeviceFacts facts;
    facts.name = text_of(api, device, CL_DEVICE_NAME);
    facts.driver = text_of(api, device, CL_DRIVER_VERSION);
    std::array<char, 256> name{};
    api.clGetPlatformInfo(platform, CL_PLATFORM_NAME, name.size() - 1, name.data(), nullptr);
    facts.platform = name.data();
    facts.is_gpu =
        (value_of<cl_device_type>(api, device, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_GPU) != 0;
    const auto single = value_of<cl_device_fp_config>(api, device, CL_DEVICE_SINGLE_FP_CONFIG);
    facts.has_fast_fma = (single & CL_FP_FMA) != 0;
    facts.promises_division = (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    facts.has_double = value_of<cl_device_fp_config>(api, device, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
    facts.memory = value_of<cl_ulong>(api, device, CL_DEVICE_GLOBAL_MEM_SIZE);
    facts.largest_buffer = value_of<cl_ulong>(api, device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    facts.largest_group = value_of<std::size_t>(api, device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
    return facts;
}

}  // namespace

Result<std::vector<FoundDevice>> find_devices() {
    const Result<const OpenclApi*> loaded = opencl_api();
    if (!loaded) return tl::unexpected(loaded.error());
    const OpenclApi& api = **loaded;
    cl_uint count = 0;
    // Without a driver, the loader reports an error here.
    if (api.clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS) return std::vector<FoundDevice>{};
    std::vector<cl_platform_id> platforms(count);
    api.clGetPlatformIDs(count, platforms.data(), nullptr);
    std::vector<FoundDevice> found;
    for (const cl_platform_id platform : platforms) {
        cl_uint devices = 0;
        if (api.clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &devices) != CL_SUCCESS)
            continue;
        std::vector<cl_device_id> ids(devices);
        api.clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, devices, ids.data(), nullptr);
        for (const cl_device_id id : ids) {
            try {
                found.push_back({platform, id, facts_of(api, platform, id)});
            } catch (const OpenclError&) {
                // A device that does not describe itself cannot be used.
            }
        }
    }
    return found;
}

void DeviceKernel::add_bytes(std::size_t size, const void* bytes) {
    check_opencl(api_->clSetKernelArg(kernel_, next_++, size, bytes), "clSetKernelArg");
}

DeviceKernel DeviceProgram::kernel(const std::string& name) const {
    cl_int code = CL_SUCCESS;
    const cl_kernel made = api_->clCreateKernel(program_, name.c_str(), &code);
    check_opencl(code, "clCreateKernel");
    return {api_, made};
}

OpenDevice::OpenDevice(const OpenclApi& api, FoundDevice found)
    : api_(api), found_(std::move(found)) {
    cl_int code = CL_SUCCESS;
    const std::array<cl_context_properties, 3> properties{
        CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(found_.platform), 0};
    context_ = api_.clCreateContext(properties.data(), 1, &found_.id, nullptr, nullptr, &code);
    check_opencl(code, "clCreateContext");
    queue_ = api_.clCreateCommandQueue(context_, found_.id, 0, &code);
    if (code != CL_SUCCESS) api_.clReleaseContext(context_);
    check_opencl(code, "clCreateCommandQueue");
}

OpenDevice::~OpenDevice() {
    api_.clReleaseCommandQueue(queue_);
    api_.clReleaseContext(context_);
}

DeviceBuffer OpenDevice::buffer(std::size_t size) const {
    cl_int code = CL_SUCCESS;
    const std::size_t made = std::max<std::size_t>(size, 16);
    const cl_mem memory = api_.clCreateBuffer(context_, CL_MEM_READ_WRITE, made, nullptr, &code);
    check_opencl(code, "clCreateBuffer");
    return {&api_, memory, made};
}

DeviceProgram OpenDevice::build(const std::string& source, const std::string& options) const {
    const char* text = source.c_str();
    const std::size_t length = source.size();
    cl_int code = CL_SUCCESS;
    const cl_program made = api_.clCreateProgramWithSource(context_, 1, &text, &length, &code);
    check_opencl(code, "clCreateProgramWithSource");
    DeviceProgram program(&api_, made);
    code = api_.clBuildProgram(made, 1, &found_.id, options.c_str(), nullptr, nullptr);
    if (code == CL_SUCCESS) return program;
    std::size_t size = 0;
    api_.clGetProgramBuildInfo(made, found_.id, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
    std::string log(size, '\0');
    api_.clGetProgramBuildInfo(made, found_.id, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    throw ProgramRefused(log.empty() ? OpenclError("clBuildProgram", code).message : log, source);
}

void OpenDevice::write(const DeviceBuffer& to, std::size_t offset, const void* bytes,
                       std::size_t size) {
    CHECK(offset + size <= to.size(), "a buffer holds what is written");
    if (size == 0) return;
    check_opencl(api_.clEnqueueWriteBuffer(queue_, to.memory(), CL_TRUE, offset, size, bytes, 0,
                                           nullptr, nullptr),
                 "clEnqueueWriteBuffer");
}

void OpenDevice::read(const DeviceBuffer& from, std::size_t offset, void* bytes, std::size_t size) {
    CHECK(offset + size <= from.size(), "a buffer holds what is read");
    if (size == 0) return;
    check_opencl(api_.clEnqueueReadBuffer(queue_, from.memory(), CL_TRUE, offset, size, bytes, 0,
                                          nullptr, nullptr),
                 "clEnqueueReadBuffer");
}

void OpenDevice::copy(const DeviceBuffer& from, std::size_t from_offset, const DeviceBuffer& to,
                      std::size_t to_offset, std::size_t size) {
    check_opencl(api_.clEnqueueCopyBuffer(queue_, from.memory(), to.memory(), from_offset,
                                          to_offset, size, 0, nullptr, nullptr),
                 "clEnqueueCopyBuffer");
}

void OpenDevice::launch(const DeviceKernel& kernel, std::size_t columns, std::size_t rows,
                        std::size_t group) {
    const std::array<std::size_t, 2> global{columns, rows}, local{group, 1};
    check_opencl(api_.clEnqueueNDRangeKernel(queue_, kernel.kernel(), 2, nullptr, global.data(),
                                             local.data(), 0, nullptr, nullptr),
                 "clEnqueueNDRangeKernel");
}

void OpenDevice::flush() { check_opencl(api_.clFlush(queue_), "clFlush"); }
void OpenDevice::finish() { check_opencl(api_.clFinish(queue_), "clFinish"); }

std::size_t OpenDevice::group_for(std::size_t columns, std::size_t unit) const {
    // Graphics processors distribute small groups among their cores. On an ordinary processor, a
    // core runs one group at a time.
    const std::size_t wanted = facts().is_gpu ? 256 : 4096;
    const std::size_t most = std::min(wanted, facts().largest_group);
    std::size_t best = std::min(unit, most);
    for (std::size_t group = unit; group <= std::min(most, columns); group += unit) {
        if (columns % group == 0) best = group;
    }
    return best;
}

}  // namespace cascade
