// Puts everything into the HTML of the page: styles and scripts unchanged, and the engine and files
// compressed (zlib) and in base64. spec/page.md describes the result.
#include "view/standalone_page.h"

#include "core/base64.h"
#include "core/check.h"
#include "core/file.h"
#include "core/shared_files.h"
#include "core/version.h"
#include "picture/deflate.h"
#include "view/page_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cascade {
namespace {

constexpr int smallest = 12;

/// Permits only the scripts of the page itself and the machine code of kernels.
constexpr std::string_view policy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
    "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; "
    "style-src 'unsafe-inline'; img-src blob: data:; media-src blob:; connect-src blob: data:\">\n";

void replace(std::string& page, std::string_view what, const std::string& by) {
    const std::size_t at = page.find(what);
    CHECK(at != std::string::npos, "page/src/index.html has what is replaced in it");
    page.replace(at, what.size(), by);
}

std::string script(std::string_view attributes, std::string_view content) {
    return std::string("<script ")
        .append(attributes)
        .append(">")
        .append(content)
        .append("</script>\n");
}

std::string packed(std::string_view bytes) { return base64(deflated(bytes, smallest)); }

/// Prints the contents as JSON. Every "<" is escaped, because "</script" in a text would end the
/// script element of the page.
std::string print(const Carried& carried) {
    nlohmann::json files = nlohmann::json::array();
    for (const auto& [name, bytes] : carried.files) files.push_back({name, packed(bytes)});
    const nlohmann::json json = {{"name", carried.name},
                                 {"text", carried.text},
                                 {"overrides", carried.overrides},
                                 {"is_exact", carried.is_exact},
                                 {"files", files}};
    std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) {
        text.replace(at, 1, "\\u003c");
    }
    return text;
}

}  // namespace

Result<std::string> read_engine() {
    const auto path = shared_file("engine.wasm");
    if (!path.empty()) return read_file(path, largest_engine);
    return failure("this program comes without engine.wasm, which pages carry",
                   "in the source tree './cascade export' builds it; elsewhere 'cmake --build "
                   "FOLDER --target cascade_engine' does");
}

std::string standalone_page(const Carried& carried, std::string_view engine) {
    const PageFiles files = page_files();
    std::string page = files.at("/").content;
    replace(page, "<link rel=\"stylesheet\" href=\"page.css\">",
            "<style>" + files.at("/page.css").content + "</style>");
    replace(page, "<script type=\"module\" src=\"page.js\"></script>\n", "");
    replace(page, "<meta charset=\"utf-8\">\n",
            fmt::format("<meta charset=\"utf-8\">\n"
                        "<meta name=\"generator\" content=\"Cascade {}\">\n{}",
                        version(), policy));
    replace(page, "</body>",
            script("type=\"application/json\" id=\"carried\"", print(carried)) +
                script("type=\"text/plain\" id=\"engine\"", packed(engine)) +
                script("type=\"text/plain\" id=\"worker\"", page_worker()) +
                script("type=\"module\"", files.at("/page.js").content) + "</body>");
    return page;
}

}  // namespace cascade
