// Writes a page and its engine to one file, which works without a server and without a network.
#pragma once

#include "core/result.h"
#include "view/carried.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cascade {

/// The largest engine that is read, in bytes.
inline constexpr std::uint64_t largest_engine = std::uint64_t{1} << 28;

/// Reads engine.wasm, which tab/engine.cmake builds (core/shared_files.h). Fails if the file is
/// missing.
Result<std::string> read_engine();

/// The page as HTML, with the engine and everything in `carried`.
std::string standalone_page(const Carried& carried, std::string_view engine);

}  // namespace cascade
