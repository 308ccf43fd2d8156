// Messages from a page. Each is a JSON object, from which typed values are read. spec/page.md lists
// all messages.
#pragma once

#include "core/result.h"
#include "run/script/picture_request.h"
#include "run/session/session_model.h"
#include "run/session/turns.h"
#include "view/loaded_models.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace cascade {

/// Gives the page a name that stays the same over several connections.
struct NamePage {
    std::string name;
};
/// The page has drawn its snapshot and is ready for the next one.
struct NextSnapshot {};
// clang-format off
// The following messages are questions, which change nothing.
struct AskForLog {};
/// Asks for names that may complete the last word of `text`.
struct AskForNames { std::string text; };
struct AskAboutName { std::string text; };  ///< Asks for the meaning of the last word of `text`.
struct AskForFixes { std::string text; };  ///< Asks for fixes of the errors in `text`.
/// Asks for the spread of each species, and for its value in one cell. `cell` is column + width ·
/// row, with rows counted through all slices, or −1 for no cell.
struct AskForValues { std::int64_t cell = -1; };
/// Asks for the distribution and spectrum of species `x`, and for the joint distribution of `x` and
/// `y`.
struct AskForMeasures { std::string x, y; };
/// Asks for the features of the value that the present stage shows, or of an expression.
struct AskForFeatures { std::string show; };
/// Asks for a PNG file that contains the session.
struct AskForPicture { PictureRequest request; };
/// Asks where the name at a byte of `text` is declared and used.
struct AskForUses { std::string text; std::size_t byte = 0; };
/// Asks for `text` in which the name at byte `byte` is renamed to `name`.
struct AskToRename { std::string text; std::size_t byte = 0; std::string name; };
// clang-format on

/// Asks for a file with the present pattern as a model. The answer is a frame.
struct SaveModel {
    PictureRequest request;
    ModelForm form = ModelForm::model;
};

/// Asks for the mesh of the surface in the newest snapshot.
struct AskForSurface {};

using PageQuestion =
    std::variant<AskForLog, AskForNames, AskAboutName, AskForFixes, AskForValues, AskForMeasures,
                 AskForFeatures, AskForPicture, AskForUses, AskToRename>;
using PageRequest = std::variant<SessionCommand, NextSnapshot, NamePage, AskForSurface,
                                 PageQuestion, LoadPart, SaveModel>;

struct PageMessage {
    /// The number that the page has given to the message, to recognise the answer. 0 if there is
    /// none.
    std::uint64_t id = 0;
    PageRequest request;
};

/// The script text in a command. Positions in diagnostics refer to it. Empty if the command has no
/// script.
std::string text_of(const SessionCommand& command);

/// The largest message, in bytes.
inline constexpr std::size_t largest_page_message = std::size_t{1} << 20;

/// Parses a message. If the text is not a valid message, fails with a sentence about the first
/// error.
Result<PageMessage> parse_page_message(std::string_view text);

}  // namespace cascade
