// The session is stored in a text chunk next to the chunks that contain the script.
#include "run/session/session_picture.h"

#include "core/enough_memory.h"
#include "render/ray_caster.h"
#include "run/pictures/picture_size.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {
Accepted<Painter> make_painter(LiveRun& run, const PictureRequest& request) {
    Script& script = run.script();
    Diagnostics warnings = std::exchange(script.diagnostics, {});
    auto made = Painter::create(script, request);
    Diagnostics errors = std::exchange(script.diagnostics, std::move(warnings));
    if (made) return std::move(*made);
    if (!errors.has_errors()) return refuse(made.error());
    Refusal refusal;
    refusal.diagnostics = std::move(errors);
    refusal.sources = script.sources;
    return tl::unexpected(std::move(refusal));
}

PngTexts embed_session(const Script& script, const PictureRequest& request, const SessionLog& log) {
    PngTexts texts = embed_script(script, request);
    texts[key_session] = print_session_log(log);
    return texts;
}

Accepted<std::string> session_picture(LiveRun& run, const PictureRequest& request) {
    auto painter = make_painter(run, request);
    if (!painter) return tl::unexpected(std::move(painter.error()));
    if (const auto fits = check_picture_size(run.script(), request); !fits) {
        return refuse(fits.error());
    }
    if (!painter->is_flat() && !RayCaster::is_available()) {
        return refuse(
            "pictures of surfaces cannot be drawn on a page that runs without the "
            "program",
            "use 'cascade view', or 'cascade run' with the session or its script");
    }
    const PngTexts texts = run.is_resumed() ? embed_script(run.script(), request)
                                            : embed_session(run.script(), request, run.log());
    auto file = enough_memory_for([&] {
        return encode_png(painter->image(painter->canvas(run.simulation())), request.png_depth(),
                          texts);
    });
    if (!file) return refuse(file.error());
    return std::move(*file);
}

Result<std::optional<SessionLog>> session_of(const LoadedFile& file) {
    if (file.session.empty()) return std::nullopt;
    auto log = parse_session_log(file.session);
    if (log) return std::move(*log);
    return failure(fmt::format("{}: {}", file.script.file.string(), log.error().message),
                   "the picture has been changed since it was written");
}

}  // namespace cascade
