// Compiles the functions of the library fmt, which exists only as native code. All other files only
// declare them.
#define FMT_HEADER_ONLY
#include <fmt/format-inl.h>

namespace {

// The compiler would omit these inline functions if their addresses were not taken.
[[gnu::used]] const auto vformat =
    static_cast<std::string (*)(fmt::string_view, fmt::format_args)>(&fmt::vformat);
[[gnu::used]] const auto throw_format_error = &fmt::detail::throw_format_error;

}  // namespace
