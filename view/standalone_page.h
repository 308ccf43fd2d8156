// The page and its engine in one file, which needs neither a server nor a network.
#pragma once

#include "core/result.h"
#include "view/carried.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cascade {

/// The largest engine, in bytes, that is read.
inline constexpr std::uint64_t largest_engine = std::uint64_t{1} << 28;

/// The engine next to this program, or in the folder of its libraries: engine.wasm, which
/// tab/engine.cmake builds. Fails if it is missing.
Result<std::string> read_engine();

/// The page as HTML, with all that it carries.
std::string standalone_page(const Carried& carried, std::string_view engine);

}  // namespace cascade
