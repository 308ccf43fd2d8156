// Messages from a page: one JSON object each, read into typed values. spec/page.md lists them.
#pragma once

#include "core/result.h"
#include "run/script/picture_request.h"
#include "run/session/turns.h"
#include "view/loaded_models.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace cascade {

/// The name that identifies the page over several connections.
struct NamePage {
    std::string name;
};
/// The page has drawn its snapshot and takes the next one.
struct NextSnapshot {};
// clang-format off
// Questions of a page, which change nothing.
struct AskForLog {};
struct AskForNames { std::string text; };  ///< Candidates for its last word.
struct AskAboutName { std::string text; };  ///< About its last word.
struct AskForFixes { std::string text; };  ///< Of the errors in it.
/// The spread of each species, and its value in a cell: column + width · row, with rows numbered
/// through all slices. −1 for no cell.
struct AskForValues { std::int64_t cell = -1; };
/// Distribution and spectrum of a species, and its joint distribution with another one.
struct AskForMeasures { std::string x, y; };
/// A PNG that carries the session.
struct AskForPicture { PictureRequest request; };
// clang-format on

/// The page asks for the mesh of the newest snapshot's surface.
struct AskForSurface {};

using PageQuestion = std::variant<AskForLog, AskForNames, AskAboutName, AskForFixes, AskForValues,
                                  AskForMeasures, AskForPicture>;
using PageRequest =
    std::variant<SessionCommand, NextSnapshot, NamePage, AskForSurface, PageQuestion, LoadPart>;

struct PageMessage {
    std::uint64_t id = 0;  ///< Chosen by the page for the answer. 0 if there was none.
    PageRequest request;
};

/// The text that messages about a command refer to; empty if there is none.
std::string text_of(const SessionCommand& command);

/// The most bytes of a message.
inline constexpr std::size_t largest_page_message = std::size_t{1} << 20;

/// Fails, with a sentence that says what is wrong, on text that is no message of a page.
Result<PageMessage> parse_page_message(std::string_view text);

}  // namespace cascade
