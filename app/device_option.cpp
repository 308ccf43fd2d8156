// Opens the device that `--device` names, and notes which stages the device does not run.
#include "app/device_option.h"

#include "app/exit_status.h"
#include "device/devices.h"
#include "run/pictures/picture_size.h"

#include <memory>
#include <set>
#include <utility>

namespace cascade {

int print_devices(Console& console) {
    const auto list = list_devices();
    if (!list) {
        console.fail(list.error());
        return exit_status::failed_run;
    }
    console.print(*list);
    return exit_status::success;
}

Result<void> use_device(const std::string& choice, const Script& script, RunRequest& request,
                        RunControl& control) {
    auto device = open_device(choice);
    if (!device) return tl::unexpected(device.error());
    const auto told = std::make_shared<std::set<std::string>>();
    const auto tell = [&control, told](const std::string& words) {
        if (control.note && told->insert(words).second) control.note("a stage " + words);
    };
    if (has_cells(script)) tell("of cells that crawl runs on threads, not on the device");
    request.simulation.executor = on_device(std::move(*device), script.program->domain.fast, tell);
    return {};
}

}  // namespace cascade
