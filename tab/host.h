// Functions of the page that its engine calls. The WebAssembly module imports them.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/// Sends a message to the page: a text, or a snapshot as bytes (spec/page.md).
[[clang::import_module("page"), clang::import_name("send_text")]] void host_send_text(
    const char* text, std::size_t size);
[[clang::import_module("page"), clang::import_name("send_frame")]] void host_send_frame(
    const char* bytes, std::size_t size);

/// Compiles a module made by wasm/kernel_module.h and adds its function to the engine's table of
/// functions. Returns the function's index in this table, or 0 on failure.
[[clang::import_module("page"), clang::import_name("add_kernel")]] std::uint32_t host_add_kernel(
    const std::uint8_t* bytes, std::size_t size);
[[clang::import_module("page"), clang::import_name("drop_kernel")]] void host_drop_kernel(
    std::uint32_t place);

// The GPU of the browser (page/src/gpu.ts). While a function waits, the engine is suspended. A
// number that the host returns for a success is not 0.

/// Waits. Asks the browser for a GPU. If the answer is 0, host_gpu_describe() gives the reason.
[[clang::import_module("gpu"), clang::import_name("open")]] int host_gpu_open();
/// Writes the name of the GPU, or the reason why there is none, and returns the number of bytes
/// written, at most `most`.
[[clang::import_module("gpu"), clang::import_name("describe")]] std::size_t host_gpu_describe(
    char* text, std::size_t most);
/// The most words of a buffer.
[[clang::import_module("gpu"), clang::import_name("largest")]] std::uint32_t host_gpu_largest();
/// Waits. Compiles two programs and makes the buffers of device/wgsl_prelude.h. `sizes` are the
/// number of words of a call, then the number of words of each buffer that host_gpu_write() can
/// write. Returns a number for the functions below, or 0 on failure.
[[clang::import_module("gpu"), clang::import_name("make")]] std::uint32_t host_gpu_make(
    const char* program, std::size_t size, const char* halo_program, std::size_t halo_size,
    const std::uint32_t* sizes);
/// Writes words to a buffer, from word `place` on. `binding` is 1 – 4.
[[clang::import_module("gpu"), clang::import_name("write")]] void host_gpu_write(
    std::uint32_t made, std::uint32_t binding, std::size_t place, const void* words,
    std::size_t count);
/// Waits. Makes calls. In `words` each call has the number of its kernel, the numbers of
/// work-groups, and its words. Kernels are numbered in the order of their texts, first those of the
/// program, then those of the program of halos. `sides` is the content of c_sides.
[[clang::import_module("gpu"), clang::import_name("run")]] int host_gpu_run(
    std::uint32_t made, const std::uint32_t* words, std::size_t count, const std::uint32_t* sides,
    std::size_t sides_count);
/// Waits. Copies `fields` fields of `count` words each, which follow each other in the buffer of
/// planes from word `place` on.
[[clang::import_module("gpu"), clang::import_name("read")]] int host_gpu_read(
    std::uint32_t made, std::size_t place, std::size_t count, void* const* to, std::size_t fields);
[[clang::import_module("gpu"), clang::import_name("drop")]] void host_gpu_drop(std::uint32_t made);

}  // extern "C"
