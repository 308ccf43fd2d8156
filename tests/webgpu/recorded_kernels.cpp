// Kernels that record their inputs, and the results of the interpreter.
#include "core/check.h"
#include "core/floating_point.h"
#include "device/probed_kernel.h"
#include "device/wgsl_kernels.h"
#include "device/wgsl_links.h"
#include "device/wgsl_prelude.h"
#include "ir/interpreter.h"
#include "tests/support/kernel_comparison.h"
#include "tests/webgpu/webgpu_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace cascade::test {
namespace {

template <typename T>
void append(std::vector<T>& all, const T* first, std::size_t count) {
    all.insert(all.end(), first, first + count);
}

/// The bytes of a case that are not yet words.
struct CaseBytes {
    std::vector<std::uint8_t> masks;
    std::vector<std::uint32_t> links;
    std::vector<std::uint32_t> places_of_links;
};

void append_words(std::vector<std::uint32_t>& words, const void* bytes, std::size_t count) {
    if (count == 0) return;
    const std::size_t first = words.size();
    words.resize(first + (count + 3) / 4);
    std::memcpy(words.data() + first, bytes, count);
}

/// Runs the interpreter's kernel, and adds its inputs and results to a case.
class RecordedForWebgpu final : public Kernel {
public:
    RecordedForWebgpu(KernelPointer interpreted, WebgpuCase& recorded, CaseBytes& bytes,
                      std::string name)
        : interpreted_(std::move(interpreted)),
          recorded_(recorded),
          bytes_(bytes),
          name_(std::move(name)) {}

    void run(const KernelArgumentsOf<float>& given, const Patch& cells) const override {
        const PlaneLayout& layout = given.layout;
        const auto size = static_cast<std::size_t>(layout.size());
        const std::int64_t first = layout.offset(0, 0);
        for (const float* const field : given.fields) {
            append_words(recorded_.planes, field - first, 4 * size);
        }
        const std::size_t place = recorded_.planes.size();
        for (const float* const result : given.results) {
            append_words(recorded_.planes, result - first, 4 * size);
        }
        for (const std::uint8_t* const mask : given.masks) append(bytes_.masks, mask - first, size);
        append_words(recorded_.uniforms, given.uniforms.data(), 4 * given.uniforms.size());
        if (given.links.starts != nullptr) {
            // The tables begin at place 0, so a case can have only one kernel of linked cells.
            CHECK(bytes_.links.empty(), "test: one kernel of linked cells in a case");
            WgslLinks links(given.links, layout);
            bytes_.links = std::move(links.words);
            bytes_.places_of_links = std::move(links.places);
        }
        interpreted_->run(given, cells);
        for (std::size_t k = 0; k < given.results.size(); ++k) {
            WebgpuCase::Expected& expected = recorded_.expected.emplace_back();
            expected.name = fmt::format("{}, result {}", name_, k);
            expected.place = place + k * size;
            append_words(expected.words, given.results[k] - first, 4 * size);
            expected.is_free.resize(size);
            // Kernels may write up to the end of a vector.
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                const std::int64_t start = first + layout.row_start(row);
                constexpr std::int64_t pad = PlaneLayout::row_pad;
                const std::int64_t end = (layout.width + pad - 1) / pad * pad;
                std::fill(expected.is_free.begin() + start + layout.width,
                          expected.is_free.begin() + start + end, std::uint8_t{1});
            }
        }
    }

private:
    KernelPointer interpreted_;
    WebgpuCase& recorded_;
    CaseBytes& bytes_;
    std::string name_;
};

void add_call(WebgpuCase& made, std::size_t number, const PlaneLayout& layout,
              const std::vector<std::uint32_t>& links) {
    WgslCall call = call_of_plane(layout);
    call.kernel = fmt::format("c_kernel_{}", number);
    call.words.insert(call.words.end(), links.begin(), links.end());
    call.words.resize(first_call_word);
    made.calls.push_back(std::move(call));
}

std::vector<const CellKernel*> pointers_to(const std::vector<CellKernel>& kernels) {
    std::vector<const CellKernel*> pointers;
    for (const CellKernel& kernel : kernels) pointers.push_back(&kernel);
    return pointers;
}

}  // namespace

WebgpuCase case_of_kernels(const std::vector<CellKernel>& kernels, const Grid& grid,
                           Flushing flushing, std::uint64_t seed, std::string name) {
    WebgpuCase made;
    made.program = wgsl_kernels(pointers_to(kernels), grid, flushing).text;
    const auto interpreter = make_interpreter();
    CaseBytes bytes;
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const HostileInputs inputs(kernels[k], grid, seed + k);
        inputs.run(RecordedForWebgpu(*interpreter->compile(kernels[k], grid.stencil()), made, bytes,
                                     fmt::format("kernel {}", k)));
        add_call(made, k, PlaneLayout(grid), bytes.places_of_links);
    }
    append_words(made.masks, bytes.masks.data(), bytes.masks.size());
    made.links = std::move(bytes.links);
    made.name = std::move(name);
    return made;
}

WebgpuCase probing_case(Flushing flushing) {
    WebgpuCase made;
    const ProbedKernel<float> probed;
    const CellKernel* const kernel = &probed.kernel;
    made.program = wgsl_kernels({&kernel, 1}, probed.grid, flushing).text;
    CaseBytes bytes;
    const auto interpreter = make_interpreter();
    const RecordedForWebgpu recorded(interpreter->find(probed.kernel, probed.grid.stencil()), made,
                                     bytes, "hard words");
    const FlushDenormals environment;
    probed.results_of(recorded);
    add_call(made, 0, PlaneLayout(probed.grid), {});
    made.name = "numbers that are difficult to round";
    return made;
}

void WebgpuCase::write(CaseFile& file) const {
    file.write(name);
    file.write(program);
    file.write(halo_program);
    for (const auto* const words : {&planes, &masks, &uniforms, &links, &sides}) file.write(*words);
    file.write(static_cast<std::uint32_t>(calls.size()));
    for (const WgslCall& call : calls) {
        file.write(call.is_halo ? 1U : 0U);
        file.write(call.kernel);
        file.write(call.words);
        file.write(call.groups_x);
        file.write(call.groups_y);
    }
    file.write(static_cast<std::uint32_t>(expected.size()));
    for (const Expected& each : expected) {
        file.write(each.name);
        file.write(static_cast<std::uint32_t>(each.place));
        file.write(each.words);
        file.write(each.is_free);
    }
    ++file.cases;
}

}  // namespace cascade::test
