// Pictures of a live run, which carry its session, and the session of such a picture.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/painter.h"
#include "run/script/picture_request.h"
#include "run/session/live_run.h"

#include <optional>
#include <string>

namespace cascade {

/// A painter of a run. Refused with the errors of `request`; the warnings of the script stay as
/// they are.
Accepted<Painter> make_painter(LiveRun& run, const PictureRequest& request);

/// What embed_script() stores, and the session.
PngTexts embed_session(const Script& script, const PictureRequest& request, const SessionLog& log);

/// The picture of the present step as a PNG file in memory. It carries the script as it is now and
/// the session, from which the same picture is drawn again. A run that began with a saved run is
/// not grown by its log, so that its pictures carry the script alone. Refused with the errors of
/// `request`, or if the picture cannot be written.
Accepted<std::string> session_picture(LiveRun& run, const PictureRequest& request);

/// The session that a picture carries, or a file of a session is; none for others. Fails, naming
/// the file, if it is not one.
Result<std::optional<SessionLog>> session_of(const LoadedFile& file);

}  // namespace cascade
