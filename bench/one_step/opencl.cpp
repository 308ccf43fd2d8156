// Steps of Gray and Scott's reaction by OpenCL, on the first device that there is
// (docs/one_step.md).
//
//   opencl KERNELS SIDE STEPS [FILE]
//
// compiles the file KERNELS, takes STEPS steps on SIDE × SIDE cells, prints the seconds of
// processor time that they took (of all threads, without compiling), and writes v to FILE.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

void check(cl_int status, const char* what) {
    if (status == CL_SUCCESS) return;
    std::fprintf(stderr, "opencl: %s: error %d\n", what, status);
    std::exit(1);
}

std::vector<float> start_v(int side) {
    std::vector<float> v;
    for (int k = 0; k < side; ++k) {
        for (int i = 0; i < side; ++i) {
            const double x = (i + 0.5) / side, y = (k + 0.5) / side;
            v.push_back(static_cast<float>(0.2 +
                                           0.1 * std::cos(10 * pi * x) * std::cos(6 * pi * y) +
                                           0.05 * std::cos(4 * pi * x) * std::cos(14 * pi * y)));
        }
    }
    return v;
}

// lines: OpenCL, the host
class Device {
public:
    explicit Device(const std::string& text) {
        cl_platform_id platform;
        check(clGetPlatformIDs(1, &platform, nullptr), "no platform");
        check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device_, nullptr), "no device");
        cl_int status;
        context_ = clCreateContext(nullptr, 1, &device_, nullptr, nullptr, &status);
        check(status, "no context");
        queue_ = clCreateCommandQueue(context_, device_, 0, &status);
        check(status, "no queue");
        const char* source = text.c_str();
        const cl_program program =
            clCreateProgramWithSource(context_, 1, &source, nullptr, &status);
        check(status, "no program");
        check(clBuildProgram(program, 1, &device_, "", nullptr, nullptr), "the kernels");
        step_ = clCreateKernel(program, "gray_scott", &status);
        check(status, "no kernel");
    }
    cl_mem plane(std::vector<float> values) const {
        cl_int status;
        const cl_mem memory = clCreateBuffer(context_, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                                             values.size() * sizeof(float), values.data(), &status);
        check(status, "no memory");
        return memory;
    }
    void step(const cl_mem (&planes)[4], int side) const {
        for (cl_uint k = 0; k < 4; ++k)
            check(clSetKernelArg(step_, k, sizeof(cl_mem), &planes[k]), "an argument");
        const std::size_t size[2] = {static_cast<std::size_t>(side),
                                     static_cast<std::size_t>(side)};
        check(clEnqueueNDRangeKernel(queue_, step_, 2, nullptr, size, nullptr, 0, nullptr, nullptr),
              "a step");
    }
    void finish() const { check(clFinish(queue_), "the steps"); }
    std::vector<float> values(cl_mem plane, std::size_t count) const {
        std::vector<float> values(count);
        check(clEnqueueReadBuffer(queue_, plane, CL_TRUE, 0, count * sizeof(float), values.data(),
                                  0, nullptr, nullptr),
              "reading");
        return values;
    }

private:
    cl_device_id device_{};
    cl_context context_{};
    cl_command_queue queue_{};
    cl_kernel step_{};
};
// end

}  // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fputs("opencl KERNELS SIDE STEPS [FILE]\n", stderr);
        return 64;
    }
    std::ifstream file(words[1]);
    const Device device(std::string(std::istreambuf_iterator<char>(file), {}));
    const int side = std::atoi(words[2]), steps = std::atoi(words[3]);
    const std::vector<float> v = start_v(side);
    std::vector<float> u;
    for (const float value : v) u.push_back(1 - value);
    cl_mem planes[4] = {device.plane(u), device.plane(v), device.plane(u), device.plane(v)};
    device.step(planes, side);  // Drivers compile at the first step. Its results are overwritten.
    device.finish();
    const std::clock_t begin = std::clock();
    for (int step = 0; step < steps; ++step) {
        device.step(planes, side);
        std::swap(planes[0], planes[2]);
        std::swap(planes[1], planes[3]);
    }
    device.finish();
    std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (count <= 4) return 0;
    const std::vector<float> end = device.values(planes[1], v.size());
    std::ofstream out(words[4], std::ios::binary);
    out.write(reinterpret_cast<const char*>(end.data()),
              static_cast<std::streamsize>(end.size() * sizeof(float)));
    return out ? 0 : 1;
}
