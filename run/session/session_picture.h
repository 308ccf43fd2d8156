// Writes pictures of a live run that contain its session, and reads the session from such a
// picture.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/painter.h"
#include "run/script/picture_request.h"
#include "run/session/live_run.h"

#include <optional>
#include <string>

namespace cascade {

/// Makes a painter for a run. Refused with the errors of `request`. Adds no warnings to the script.
Accepted<Painter> make_painter(LiveRun& run, const PictureRequest& request);

/// Returns the texts of embed_script() and a text with the session.
PngTexts embed_session(const Script& script, const PictureRequest& request, const SessionLog& log);

/// Draws the present step as a PNG file in memory. The file contains the present script and the
/// session, from which the same picture can be drawn again. If the run began with a saved run, the
/// log cannot reproduce the run, so the file contains only the script. Refused with the errors of
/// `request`, or if the picture cannot be written.
Accepted<std::string> session_picture(LiveRun& run, const PictureRequest& request);

/// Reads the session from a picture or a session file. Returns an empty optional for other files.
/// If the session is invalid, fails with a message that names the file.
Result<std::optional<SessionLog>> session_of(const LoadedFile& file);

}  // namespace cascade
