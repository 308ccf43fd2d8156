// Devices that are lost, refuse programs, lack memory or compute other bits. OpenCL's functions are
// replaced to make a good device fail.
#include "device/device.h"
#include "device/opencl_api.h"
#include "tests/support/kernel_comparison.h"
#include "tests/agreement/script_outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

namespace cascade::test {
namespace {

using testing::HasSubstr;

const std::string two_stages =
    "domain { grid: 20, 10 }\nsystem s { u: sx\nu' = 0.1 * lap(u) }\n"
    "stage first: s { iterations: 5 }\nstage second: s { iterations: 400; interval: 100 }\n";

OpenclApi working() {
    const auto api = opencl_api();
    EXPECT_TRUE(api);
    return api ? **api : OpenclApi{};
}

FoundDevice found() {
    const auto all = find_devices();
    EXPECT_TRUE(all && !all->empty());
    return all && !all->empty() ? all->front() : FoundDevice{};
}

/// Runs the script on a device. `told` gets the notes of the executor.
Outcome run_on(const OpenclApi& api, const FoundDevice& device, bool may_differ = false,
               std::string* told = nullptr) {
    SimulationOptions options{"interp", 0, 1};
    options.executor = on_device(std::make_shared<Device>(api, device), may_differ,
                                 [told](const std::string& words) {
                                     if (told) *told = words;
                                 });
    return run_script("two stages", two_stages, {}, options);
}

TEST(FailingDevice, ThatIsLostEndsTheStageAtItsStart) {
    static int left = 0;
    OpenclApi api = working();
    static const auto finish = api.clFinish;
    api.clFinish = [](cl_command_queue queue) {
        return --left < 0 ? CL_OUT_OF_RESOURCES : finish(queue);
    };
    // The first stage ends before the device is lost.
    left = 12;
    const Outcome lost = run_on(api, found());
    EXPECT_THAT(lost.failure, HasSubstr("stage 'second'"));
    EXPECT_THAT(lost.failure, HasSubstr("was lost (clFinish -5)"));
    EXPECT_THAT(lost.failure, HasSubstr("--checkpoint"));
    // The second stage is reset to its start, u = sx.
    Outcome good = run_script("two stages", two_stages, {}, {"interp", 0, 1}, 5);
    ASSERT_EQ(good.fields.size(), 2U);
    good.fields[1] =
        run_script("two stages", two_stages, {}, {"interp", 0, 1}, 0).fields[1].clone();
    EXPECT_EQ(same_bits(lost.fields, good.fields), "");
}

TEST(FailingDevice, WhoseDriverCannotCompileIsSaidWithItsMessage) {
    OpenclApi api = working();
    api.clBuildProgram = [](auto...) -> cl_int { return CL_BUILD_PROGRAM_FAILURE; };
    api.clGetProgramBuildInfo = [](cl_program, cl_device_id, cl_program_build_info,
                                   std::size_t size, void* log, std::size_t* needed) -> cl_int {
        constexpr char text[] = "a note\nline 7: error: no such thing\nthe end\n";
        if (needed != nullptr) *needed = sizeof text;
        if (log != nullptr) std::memcpy(log, text, std::min(size, sizeof text));
        return CL_SUCCESS;
    };
    const Outcome outcome = run_on(api, found());
    EXPECT_THAT(outcome.failure, HasSubstr("stage 'first': the driver of "));
    EXPECT_THAT(outcome.failure,
                HasSubstr("cannot compile a program: line 7: error: no such thing"));
    EXPECT_THAT(outcome.failure, HasSubstr("CASCADE_DEVICE_SOURCE"));
}

TEST(FailingDevice, WithTooLittleMemoryIsRefusedBeforeTheFirstStep) {
    const OpenclApi api = working();
    FoundDevice small = found();
    small.facts.memory = 4000;
    const Outcome outcome = run_on(api, small);
    EXPECT_THAT(outcome.failure, HasSubstr("the steps need "));
    EXPECT_THAT(outcome.failure, HasSubstr("cells, or leave --device out"));
}

TEST(FailingDevice, WithoutDoublePrecisionTakesNoAdaptiveSteps) {
    const OpenclApi api = working();
    FoundDevice plain = found();
    plain.facts.has_double = false;
    SimulationOptions options{"interp", 0, 1};
    std::string told;
    options.executor = on_device(std::make_shared<Device>(api, plain), false,
                                 [&](const std::string& words) { told = words; });
    const std::string chosen =
        "domain { grid: 20, 10 }\nsystem s { u: sx\nu' = 0.1 * lap(u) }\n"
        "stage only: s { duration: 3; solver: rk23 }\n";
    const Outcome outcome = run_script("chosen steps", chosen, {}, options);
    EXPECT_EQ(outcome.failure, "");
    EXPECT_THAT(told, HasSubstr("which the device lacks"));
    EXPECT_EQ(same_bits(outcome.fields,
                        run_script("chosen steps", chosen, {}, {"interp", 0, 1}).fields),
              "");
}

TEST(FailingDevice, WithOtherBitsIsRefusedUnlessTheyMayDiffer) {
    OpenclApi api = working();
    static const auto read = api.clEnqueueReadBuffer;
    api.clEnqueueReadBuffer = [](cl_command_queue queue, cl_mem memory, cl_bool blocks,
                                 std::size_t offset, std::size_t size, void* to, cl_uint count,
                                 const cl_event* list, cl_event* event) -> cl_int {
        const cl_int code = read(queue, memory, blocks, offset, size, to, count, list, event);
        // Changes the last bit of a number that is neither zero nor NaN.
        for (std::size_t k = 0; k + 4 <= size; k += 4) {
            float number = 0;
            std::memcpy(&number, static_cast<char*>(to) + k, 4);
            if (!(number > 1 && number < 2)) continue;
            static_cast<char*>(to)[k] ^= 1;
            break;
        }
        return code;
    };
    EXPECT_THAT(run_on(api, found()).failure, HasSubstr("is not bit-exact: "));
    std::string told;
    EXPECT_EQ(run_on(api, found(), true, &told).failure, "");
    EXPECT_THAT(told, HasSubstr("which is not bit-exact: "));
}

}  // namespace
}  // namespace cascade::test
