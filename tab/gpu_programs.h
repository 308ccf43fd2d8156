// Programs in WGSL on the GPU of the browser, with the contents of their buffers.
#pragma once

#include "core/plane.h"
#include "device/wgsl_steps.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The name of the GPU, or the reason why there is none or why it failed.
std::string about_gpu();

/// The buffers of two programs. Every function that waits returns false if the GPU has failed.
class GpuPrograms {
public:
    /// Waits. `words` are the numbers of words of c_planes, c_mask_words, c_uniforms and c_links.
    GpuPrograms(const std::string& program, const std::string& halo_program,
                std::size_t words_of_call, const std::vector<std::size_t>& words);
    ~GpuPrograms();
    GpuPrograms(const GpuPrograms&) = delete;
    GpuPrograms& operator=(const GpuPrograms&) = delete;

    bool is_made() const { return made_ != 0; }
    /// Writes words to c_planes, or to another buffer by its binding.
    void write(std::size_t place, const void* words, std::size_t count, std::uint32_t binding = 1);
    void write(std::uint32_t binding, const std::vector<std::uint32_t>& words);
    /// Adds a call. `kernel` is its number; see host_gpu_run().
    void add(std::size_t kernel, const WgslCall& call);
    /// Waits. Makes the added calls.
    bool run(const std::vector<std::uint32_t>& sides);
    /// Waits. Reads fields that follow each other in c_planes.
    bool read(std::size_t place, std::span<Field> fields) const;

private:
    std::size_t words_of_call_;
    std::uint32_t made_;
    std::vector<std::uint32_t> calls_;
};

}  // namespace cascade
