// Chooses devices and lists them.
#include "device/device.h"

#include "core/file.h"
#include "device/build_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <sstream>

namespace cascade {
namespace {

constexpr std::string_view hint_for_drivers =
    "install a driver with OpenCL: mesa-opencl-icd (AMD), intel-opencl-icd, nvidia-opencl-icd; "
    "pocl-opencl-icd computes on the processor";

std::string_view kind_of(const DeviceFacts& facts) { return facts.is_gpu ? "gpu" : "cpu"; }

std::string count_in_words(std::size_t count) {
    return count == 1 ? "there is one device, number 0"
                      : fmt::format("there are {} devices, numbers 0 to {}", count, count - 1);
}

Result<FoundDevice> choose(std::vector<FoundDevice> all, std::string_view choice) {
    for (FoundDevice& each : all) {
        if (kind_of(each.facts) == choice) return std::move(each);
    }
    if (choice == "gpu" || choice == "cpu") {
        return failure(fmt::format("no device is a {}",
                                   choice == "gpu" ? "graphics processor" : "processor"),
                       count_in_words(all.size()));
    }
    std::size_t number = 0;
    std::from_chars(choice.data(), choice.data() + choice.size(), number);
    if (number < all.size()) return std::move(all[number]);
    return failure(fmt::format("there is no device {}", choice), count_in_words(all.size()));
}

Result<std::vector<FoundDevice>> all_devices() {
    auto all = find_devices();
    if (all && all->empty()) {
        return failure("OpenCL finds no device", std::string(hint_for_drivers));
    }
    return all;
}

/// The first line of a driver's messages that contains an error, or else the first line.
std::string first_error(const std::string& log) {
    std::istringstream lines(log);
    std::string line, first;
    while (std::getline(lines, line)) {
        if (line.find("error") != std::string::npos) return line;
        if (first.empty()) first = line;
    }
    return first;
}

std::string exactness(Device& device) {
    const auto in_words = [&](Precision precision) {
        return device.probe(precision).is_exact()
                   ? std::string("the same bits")
                   : "not bit-exact: " + device.probe(precision).fault;
    };
    if (!device.facts().has_double) return in_words(Precision::single) + "; no double precision";
    const std::string single = in_words(Precision::single);
    const std::string with_double = in_words(Precision::binary64);
    return single == with_double ? single : fmt::format("{}; in double: {}", single, with_double);
}

}  // namespace

const ProbeResult& Device::probe(Precision precision) {
    const auto found = probes_.find(precision);
    if (found != probes_.end()) return found->second;
    return probes_.emplace(precision, cascade::probe(open_, precision)).first->second;
}

const DeviceProgram& Device::program(const std::string& source, const TextTarget& target) {
    const auto found = programs_.find(source);
    if (found != programs_.end()) return found->second;
    return programs_.emplace(source, open_.build(source, build_options(target, facts())))
        .first->second;
}

ExecutorFailure failure_of(const DeviceFacts& facts, const OpenclError& error) {
    return ExecutorFailure(
        {fmt::format("{} failed: {}", facts.name, error.message),
         "use --checkpoint 10m to save the run while it goes on, so that it can continue on "
         "threads"});
}

ExecutorFailure failure_of(const DeviceFacts& facts, const ProgramRefused& refusal) {
    std::string hint =
        "set CASCADE_DEVICE_SOURCE=FILE.cl to keep the program and all messages for a report";
    const char* const path = std::getenv("CASCADE_DEVICE_SOURCE");
    if (path != nullptr && *path != '\0') {
        const auto written =
            write_file(path, fmt::format("{}\n#if 0\n{}\n#endif\n", refusal.source, refusal.log));
        hint = written ? fmt::format("the program and all messages are in {}", path)
                       : written.error().message;
    }
    return ExecutorFailure({fmt::format("the driver of {} cannot compile a program: {}", facts.name,
                                        first_error(refusal.log)),
                            hint});
}

Result<std::shared_ptr<Device>> open_device(std::string_view choice) {
    auto all = all_devices();
    if (!all) return tl::unexpected(all.error());
    auto found = choose(std::move(*all), choice);
    if (!found) return tl::unexpected(found.error());
    const std::string name = found->facts.name;
    try {
        return std::make_shared<Device>(**opencl_api(), std::move(*found));
    } catch (const OpenclError& error) {
        return failure(fmt::format("{} cannot be opened: {}", name, error.message));
    }
}

Result<std::string> list_devices() {
    const auto all = all_devices();
    if (!all) return tl::unexpected(all.error());
    std::string text;
    for (std::size_t k = 0; k < all->size(); ++k) {
        const DeviceFacts& facts = (*all)[k].facts;
        std::string bits;
        try {
            Device device(**opencl_api(), (*all)[k]);
            bits = exactness(device);
        } catch (const OpenclError& error) {
            bits = "cannot be used: " + error.message;
        } catch (const ProgramRefused& refusal) {
            bits = "cannot be used: " + failure_of(facts, refusal).failure.message;
        }
        text += fmt::format("{}  {}  {}, {:.1f} GB, {} {}\n   {}\n", k, kind_of(facts), facts.name,
                            static_cast<double>(facts.memory) / 1e9, facts.platform, facts.driver,
                            bits);
    }
    return text;
}

}  // namespace cascade
