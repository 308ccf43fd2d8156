// Pictures of a live run, which carry its session, and the session in such a picture.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/painter.h"
#include "run/script/picture_request.h"
#include "run/session/live_run.h"

#include <optional>
#include <string>

namespace cascade {

/// A painter of a run. Refused with the errors of `request`. The warnings of the script stay
/// unchanged.
Accepted<Painter> make_painter(LiveRun& run, const PictureRequest& request);

/// The texts of embed_script(), and the session.
PngTexts embed_session(const Script& script, const PictureRequest& request, const SessionLog& log);

/// The picture of the present step as a PNG file in memory. It carries the present script and the
/// session, from which the same picture can be drawn again. The log of a run that began with a
/// saved run does not reproduce it, so its pictures carry only the script. Refused with the errors
/// of `request`, or if the picture cannot be written.
Accepted<std::string> session_picture(LiveRun& run, const PictureRequest& request);

/// The session in a picture or a session file. Empty for other files. Fails, naming the file, if
/// the session is invalid.
Result<std::optional<SessionLog>> session_of(const LoadedFile& file);

}  // namespace cascade
