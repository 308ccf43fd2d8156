// The functions of OpenCL 1.2, loaded when a device is requested. Cascade does not link the loader,
// so everything else works without it.
//
// Internal to device/.
#pragma once

#include "core/result.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <exception>
#include <string>

namespace cascade {

#define CASCADE_OPENCL_FUNCTIONS(use)                                                        \
    use(clGetPlatformIDs) use(clGetPlatformInfo) use(clGetDeviceIDs) use(clGetDeviceInfo)    \
        use(clCreateContext) use(clReleaseContext) use(clCreateCommandQueue)                 \
            use(clReleaseCommandQueue) use(clCreateProgramWithSource) use(clBuildProgram)    \
                use(clGetProgramBuildInfo) use(clReleaseProgram) use(clCreateKernel)         \
                    use(clReleaseKernel) use(clSetKernelArg) use(clGetKernelWorkGroupInfo)   \
                        use(clCreateBuffer) use(clReleaseMemObject) use(clEnqueueReadBuffer) \
                            use(clEnqueueWriteBuffer) use(clEnqueueCopyBuffer)               \
                                use(clEnqueueNDRangeKernel) use(clFlush) use(clFinish)

struct OpenclApi {
#define CASCADE_MEMBER(name) decltype(&::name) name = nullptr;
    CASCADE_OPENCL_FUNCTIONS(CASCADE_MEMBER)
#undef CASCADE_MEMBER
};

/// The functions of the system's loader, libOpenCL.so.1. Fails with a hint about what to install if
/// the loader is missing. The library stays loaded.
Result<const OpenclApi*> opencl_api();

/// Thrown when a call to OpenCL fails: the device was lost, or lacks memory.
struct OpenclError : std::exception {
    OpenclError(std::string what_failed, cl_int error_code);
    const char* what() const noexcept override { return message.c_str(); }

    std::string message;  ///< A text such as "clFinish: out of resources (-5)".
    cl_int code;
};

/// Throws an OpenclError unless `code` is CL_SUCCESS.
void check_opencl(cl_int code, const char* function);

}  // namespace cascade
