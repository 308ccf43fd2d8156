// Messages to a page: JSON texts, and snapshots as binary frames. spec/page.md has the layout.
#pragma once

#include "core/run_control.h"
#include "run/pictures/shown_surface.h"
#include "run/session/turns.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

/// The palettes, which do not change while a page is open.
std::string print_palettes();

/// The systems of the library, each with a script to start from and words for searching.
std::string print_systems();

/// The script of a run, its parameters with a range, for sliders, and the species of the current
/// stage.
std::string print_script(const LiveRun& run);

/// A number that changes when print_script() does: with the script, and when a stage begins.
std::uint64_t version_of_script(const Snapshot& snapshot);

/// The answer to the message `id`. Diagnostics in `text`, the script as the page sees it, carry
/// their location in it.
std::string print_answer(std::uint64_t id, const Accepted<void>& result, std::string_view text);

/// The answer to a message that could not be read or obeyed.
std::string print_failure(std::uint64_t id, const Failure& failure);

/// What the session is doing that takes long; nothing after it.
std::string print_progress(const Progress& progress);

/// The answer to a part of a model: with its name when all of it is there.
std::string print_loaded(std::uint64_t id, const Result<std::string>& name);

/// A snapshot: the size of the header, as 4 bytes, least significant first; the header, JSON,
/// padded with blanks to a multiple of 4 bytes; the shown fields, row after row, as binary32.
std::string print_snapshot(const Snapshot& snapshot);

/// A surface with its number, laid out like a snapshot: positions, normals, texture coordinates,
/// triangles, ends of shares, and the shares, each a cell and a weight. Each number has 4 bytes.
std::string print_surface(const ShownSurface& surface, std::uint64_t number);

}  // namespace cascade
