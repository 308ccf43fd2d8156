// OpenCL devices, their memory, programs and queue.
//
// All functions throw an OpenclError if a call to OpenCL fails, unless they return a Result.
#pragma once

#include "core/result.h"
#include "device/opencl_api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// The properties that a device reports.
struct DeviceFacts {
    std::string name, platform, driver;
    bool is_gpu = false;
    bool has_double = false;
    bool has_fast_fma = false;
    /// Whether binary32 quotients and roots are rounded correctly.
    bool promises_division = false;
    std::uint64_t memory = 0;  ///< In bytes.
    std::uint64_t largest_buffer = 0;
    std::size_t largest_group = 1;  ///< The largest number of work-items in a work-group.
};

struct FoundDevice {
    cl_platform_id platform = nullptr;
    cl_device_id id = nullptr;
    DeviceFacts facts;
};

/// All devices of all drivers, in their order. Fails if there is no loader.
Result<std::vector<FoundDevice>> find_devices();

/// Memory of a device. Movable.
class DeviceBuffer {
public:
    DeviceBuffer() = default;
    DeviceBuffer(const OpenclApi* api, cl_mem memory, std::size_t size)
        : api_(api), memory_(memory), size_(size) {}
    DeviceBuffer(DeviceBuffer&& other) noexcept { swap(other); }
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~DeviceBuffer() {
        if (memory_ != nullptr) api_->clReleaseMemObject(memory_);
    }

    cl_mem memory() const { return memory_; }
    std::size_t size() const { return size_; }

private:
    void swap(DeviceBuffer& other) noexcept {
        std::swap(api_, other.api_);
        std::swap(memory_, other.memory_);
        std::swap(size_, other.size_);
    }
    const OpenclApi* api_ = nullptr;
    cl_mem memory_ = nullptr;
    std::size_t size_ = 0;
};

/// A kernel of a program, and the number of the argument that is set next. Movable.
class DeviceKernel {
public:
    DeviceKernel() = default;
    DeviceKernel(const OpenclApi* api, cl_kernel kernel) : api_(api), kernel_(kernel) {}
    DeviceKernel(DeviceKernel&& other) noexcept { swap(other); }
    DeviceKernel& operator=(DeviceKernel&& other) noexcept {
        swap(other);
        return *this;
    }
    ~DeviceKernel() {
        if (kernel_ != nullptr) api_->clReleaseKernel(kernel_);
    }

    cl_kernel kernel() const { return kernel_; }
    /// Sets all arguments in order. An argument is a buffer or a number.
    template <typename... Arguments>
    void set(const Arguments&... arguments) {
        begin();
        (add(arguments), ...);
    }
    // Sets the arguments one at a time: begin(), then add() for each argument.
    void begin() { next_ = 0; }
    void add(const DeviceBuffer& buffer) {
        const cl_mem memory = buffer.memory();
        add_bytes(sizeof memory, &memory);
    }
    template <typename Number>
    requires std::is_arithmetic_v<Number>
    void add(Number number) { add_bytes(sizeof number, &number); }

private:
    void add_bytes(std::size_t size, const void* bytes);
    void swap(DeviceKernel& other) noexcept {
        std::swap(api_, other.api_);
        std::swap(kernel_, other.kernel_);
    }
    const OpenclApi* api_ = nullptr;
    cl_kernel kernel_ = nullptr;
    cl_uint next_ = 0;
};

/// A compiled program. Movable.
class DeviceProgram {
public:
    DeviceProgram() = default;
    DeviceProgram(const OpenclApi* api, cl_program program) : api_(api), program_(program) {}
    DeviceProgram(DeviceProgram&& other) noexcept { swap(other); }
    DeviceProgram& operator=(DeviceProgram&& other) noexcept {
        swap(other);
        return *this;
    }
    ~DeviceProgram() {
        if (program_ != nullptr) api_->clReleaseProgram(program_);
    }
    DeviceKernel kernel(const std::string& name) const;

private:
    void swap(DeviceProgram& other) noexcept {
        std::swap(api_, other.api_);
        std::swap(program_, other.program_);
    }
    const OpenclApi* api_ = nullptr;
    cl_program program_ = nullptr;
};

/// Thrown if a driver cannot compile a program.
struct ProgramRefused : std::exception {
    ProgramRefused(std::string messages, std::string text)
        : log(std::move(messages)), source(std::move(text)) {}
    const char* what() const noexcept override { return log.c_str(); }

    std::string log;     ///< The driver's messages.
    std::string source;  ///< The text of the program.
};

/// A device with a queue. Commands run in the order in which they are added.
class OpenDevice {
public:
    OpenDevice(const OpenclApi& api, FoundDevice found);
    ~OpenDevice();
    OpenDevice(const OpenDevice&) = delete;
    OpenDevice& operator=(const OpenDevice&) = delete;

    const DeviceFacts& facts() const { return found_.facts; }

    /// Memory of at least `size` bytes, not initialised.
    DeviceBuffer buffer(std::size_t size) const;
    /// Throws ProgramRefused.
    DeviceProgram build(const std::string& source, const std::string& options) const;

    void write(const DeviceBuffer& to, std::size_t offset, const void* bytes, std::size_t size);
    void read(const DeviceBuffer& from, std::size_t offset, void* bytes, std::size_t size);
    void copy(const DeviceBuffer& from, std::size_t from_offset, const DeviceBuffer& to,
              std::size_t to_offset, std::size_t size);
    /// Adds a kernel that runs on columns × rows work-items. A work-group consists of `group`
    /// columns of one row. `columns` is a multiple of `group`.
    void launch(const DeviceKernel& kernel, std::size_t columns, std::size_t rows,
                std::size_t group);
    /// Starts the commands added so far.
    void flush();
    /// Waits until all added commands have been executed.
    void finish();

    /// The number of columns in a work-group: the largest multiple of `unit` that divides `columns`
    /// and is not above a limit of the device.
    std::size_t group_for(std::size_t columns, std::size_t unit) const;

private:
    const OpenclApi& api_;
    FoundDevice found_;
    cl_context context_ = nullptr;
    cl_command_queue queue_ = nullptr;
};

}  // namespace cascade
