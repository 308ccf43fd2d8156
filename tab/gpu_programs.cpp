// Calls the functions of the page that use the GPU.
#include "tab/gpu_programs.h"

#include "core/check.h"
#include "core/shared_plane.h"
#include "tab/host.h"

#include <array>

namespace cascade {

std::string about_gpu() {
    std::array<char, 512> text{};
    return {text.data(), host_gpu_describe(text.data(), text.size())};
}

GpuPrograms::GpuPrograms(const std::string& program, const std::string& halo_program,
                         std::size_t words_of_call, const std::vector<std::size_t>& words)
    : words_of_call_(words_of_call) {
    std::vector<std::uint32_t> sizes{static_cast<std::uint32_t>(words_of_call)};
    for (const std::size_t count : words) sizes.push_back(static_cast<std::uint32_t>(count));
    made_ = host_gpu_make(program.data(), program.size(), halo_program.data(), halo_program.size(),
                          sizes.data());
}

GpuPrograms::~GpuPrograms() {
    if (is_made()) host_gpu_drop(made_);
}

void GpuPrograms::write(std::size_t place, const void* words, std::size_t count,
                        std::uint32_t binding) {
    if (count > 0) host_gpu_write(made_, binding, place, words, count);
}

void GpuPrograms::write(std::uint32_t binding, const std::vector<std::uint32_t>& words) {
    write(0, words.data(), words.size(), binding);
}

void GpuPrograms::add(std::size_t kernel, const WgslCall& call) {
    CHECK(call.words.size() <= words_of_call_, "calls are as long as the host expects");
    const std::size_t end = calls_.size() + 3 + words_of_call_;
    calls_.insert(calls_.end(), {static_cast<std::uint32_t>(kernel), call.groups_x, call.groups_y});
    calls_.insert(calls_.end(), call.words.begin(), call.words.end());
    calls_.resize(end);
}

bool GpuPrograms::run(const std::vector<std::uint32_t>& sides) {
    const bool is_done =
        host_gpu_run(made_, calls_.data(), calls_.size(), sides.data(), sides.size()) != 0;
    calls_.clear();
    return is_done;
}

bool GpuPrograms::read(std::size_t place, std::span<Field> fields) const {
    std::vector<void*> to;
    for (const Field& field : fields) to.push_back(const_cast<void*>(memory_of(field)));
    const auto count = static_cast<std::size_t>(fields[0].layout().size());
    return host_gpu_read(made_, place, count, to.data(), to.size()) != 0;
}

}  // namespace cascade
