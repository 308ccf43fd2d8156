// Replaces all other files of device/ in builds without the headers of OpenCL.
#include "device/devices.h"

namespace cascade {

class Device {};

namespace {

tl::unexpected<Failure> no_opencl() {
    return failure("this program was built without OpenCL",
                   "install the package opencl-c-headers and build again");
}

}  // namespace

Result<std::shared_ptr<Device>> open_device(std::string_view) { return no_opencl(); }
Result<std::string> list_devices() { return no_opencl(); }
MakeExecutor on_device(std::shared_ptr<Device>, bool, std::function<void(const std::string&)>) {
    return make_thread_executor;
}

}  // namespace cascade
