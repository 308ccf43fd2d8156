// Systems of the library and random scripts give the same bits on a device as on threads.
#include "device/devices.h"
#include "lang/library/library.h"
#include "tests/agreement/random_scripts.h"
#include "tests/agreement/script_outcome.h"
#include "tests/support/new_seed.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace cascade::test {
namespace {

/// Whether all scripts are compared, as tests/heavy/device_kernels_test.sh does. Otherwise only a
/// sample is compared, because drivers compile each script anew.
bool compares_all() { return std::getenv("CASCADE_DEVICE_KERNELS") != nullptr; }

/// Expects the same results of a script on the device and on threads. Returns whether the device
/// took the steps of all stages.
bool compare_with_threads(const std::string& name, const std::string& text,
                          const Overrides& overrides) {
    static const auto device = open_device("cpu");
    EXPECT_TRUE(device) << (device ? "" : device.error().message);
    if (!device) return false;
    bool took_all = true;
    SimulationOptions options{"interp", 0, 1};
    options.executor = on_device(*device, false, [&](const std::string&) { took_all = false; });
    expect_same(run_script(name, text, overrides, {"interp", 0, 1}),
                run_script(name, text, overrides, options), name + "\n" + text);
    return took_all;
}

TEST(ScriptsOnADevice, OfTheLibrary) {
    const std::uint64_t every = compares_all() ? 1 : 19;
    const auto all = library_texts();
    std::size_t compared = 0, taken = 0;
    for (std::uint64_t k = new_seed() % every; k < all.size(); k += every, ++compared) {
        Overrides overrides;
        overrides.steps = 12;
        overrides.grid = GridSize{36, 29, 1};
        taken += compare_with_threads(std::string(all[k].system_name()), std::string(all[k].text),
                                      overrides);
        if (HasFailure()) return;
    }
    RecordProperty("compared", static_cast<int>(compared));
    if (compares_all()) {
        EXPECT_GE(taken, 55U) << "of " << compared;
    }
}

TEST(ScriptsOnADevice, ThatAreRandom) {
    const std::uint64_t count = compares_all() ? 60 : 2, first = new_seed();
    for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
        compare_with_threads(std::to_string(seed), random_script(seed), {});
    }
}

}  // namespace
}  // namespace cascade::test
