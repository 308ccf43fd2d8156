// Messages to a page: JSON texts, and snapshots as binary frames. spec/page.md describes their
// layout.
#pragma once

#include "core/run_control.h"
#include "run/pictures/shown_surface.h"
#include "run/session/session_model.h"
#include "run/session/turns.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

/// All palettes, which do not change while a page is open.
std::string print_palettes();

/// The systems of the library. Each has a script that uses it, and words by which users may search
/// for it.
std::string print_systems();

/// The script of a run, its uniform parameters with a range (the page shows them as sliders), and
/// the species of the current stage.
std::string print_script(const LiveRun& run);

/// A number that changes whenever the result of print_script() changes, that is, when the script
/// changes or a stage begins.
std::uint64_t version_of_script(const Snapshot& snapshot);

/// The answer to the message with the number `id`. `text` is the script that the page shows. The
/// positions of diagnostics refer to it.
std::string print_answer(std::uint64_t id, const Accepted<void>& result, std::string_view text);

/// The answer to a message that could not be read or carried out.
std::string print_failure(std::uint64_t id, const Failure& failure);

/// The engine that takes the steps of a page without the program: "WebGPU" or "WebAssembly".
/// `about` is the name of the GPU, or the reason why the engine is not WebGPU.
std::string print_engine(std::string_view name, std::string_view about);

/// Describes the slow operation in progress. Empty when the operation has ended.
std::string print_progress(const Progress& progress);

/// The answer to a part of a model. Contains the model's name once the model is complete.
std::string print_loaded(std::uint64_t id, const Result<std::string>& name);

/// A snapshot as a binary frame. It begins with the size of the header in 4 bytes, least
/// significant byte first. Then follow the header in JSON, padded with blanks to a multiple of 4
/// bytes, and the fields that the page shows, in binary32, row by row.
std::string print_snapshot(const Snapshot& snapshot);

/// The file that the message `id` asked for, in the layout of a snapshot: its bytes, then zeros up
/// to a multiple of 4.
std::string print_saved(std::uint64_t id, const SavedModel& saved);

/// A position in a text: the line, counted from 1, and the column as JavaScript counts it, from 0.
std::array<std::size_t, 2> place_in_text(std::string_view text, std::size_t byte);

/// A surface and its number, in the layout of a snapshot. The header is followed by positions,
/// normals, texture coordinates, triangles, the ends of each vertex's shares, and the shares. A
/// share consists of a cell and its weight. Every number has 4 bytes.
std::string print_surface(const ShownSurface& surface, std::uint64_t number);

}  // namespace cascade
