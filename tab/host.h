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

}  // extern "C"
