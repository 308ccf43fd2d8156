// What a page says: one JSON object a message, read into typed values. spec/page.md lists
// them.
#pragma once

#include "core/result.h"
#include "run/script/picture_request.h"
#include "run/session/turns.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace cascade {

/// The name by which the page is known over several connections.
struct NamePage {
    std::string name;
};
/// The page has drawn what it has and takes the next snapshot.
struct NextSnapshot {};
// clang-format off
// What a page asks, without changing anything.
struct AskForLog {};
struct AskForNames { std::string text; };  ///< That may stand in place of its last word.
struct AskAboutName { std::string text; };  ///< About its last word.
/// The spread of each species, and its value in a cell: column + width · row, with rows numbered
/// through all slices. No cell if it is −1.
struct AskForValues { std::int64_t cell = -1; };
/// Distribution and spectrum of a species, and how it and another one occur together.
struct AskForMeasures { std::string x, y; };
/// A PNG that carries the session.
struct AskForPicture { PictureRequest request; };
// clang-format on

/// The page asks for the mesh of the surface that the newest snapshot lies on.
struct AskForSurface {};

using PageQuestion =
    std::variant<AskForLog, AskForNames, AskAboutName, AskForValues, AskForMeasures, AskForPicture>;
using PageRequest =
    std::variant<SessionCommand, NextSnapshot, NamePage, AskForSurface, PageQuestion>;

struct PageMessage {
    std::uint64_t id = 0;  ///< Chosen by the page; the answer carries it. 0 if there was none.
    PageRequest request;
};

/// The text that messages about a command are about; empty if there is none.
std::string text_of(const SessionCommand& command);

/// The most bytes of a message.
inline constexpr std::size_t largest_page_message = std::size_t{1} << 20;

/// Fails, with a sentence that says what is wrong, on everything that is no message of a page.
Result<PageMessage> parse_page_message(std::string_view text);

}  // namespace cascade
