// Every terminal answers the last query, which asks for its features (DA1). After that answer there
// is no need to wait for answers to earlier queries, which some terminals do not support. If a
// terminal prints such a query as text, the text is erased.
#include "app/terminal_pictures.h"

#include "picture/terminal_graphics.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <vector>

namespace cascade {
namespace {

constexpr std::string_view features = "\x1b[c", cell_size = "\x1b[16t";
constexpr std::string_view kitty = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\";
constexpr std::string_view erase_line = "\r\x1b[K";

std::string_view variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

/// Reads the numbers, which are separated by semicolons.
std::vector<int> numbers_in(std::string_view text) {
    std::vector<int> numbers(1);
    for (const char c : text) {
        if (c == ';') numbers.push_back(0);
        else if (c >= '0' && c <= '9')
            numbers.back() = std::min(numbers.back() * 10 + c - '0', 9999);
    }
    return numbers;
}

/// Returns the parameters of the first control sequence that begins with `begin` and ends with
/// `end`. Returns an empty optional if there is none.
std::optional<std::string_view> sequence(std::string_view text, std::string_view begin, char end) {
    for (std::size_t at = text.find(begin); at != std::string_view::npos;
         at = text.find(begin, at + 1)) {
        const std::size_t first = at + begin.size();
        const std::size_t last = text.find_first_not_of("0123456789;", first);
        if (last != std::string_view::npos && text[last] == end) {
            return text.substr(first, last - first);
        }
    }
    return std::nullopt;
}

bool has_answered(std::string_view text) { return sequence(text, "\x1b[?", 'c').has_value(); }

/// Turns off echo and buffering of standard input, during its lifetime.
class RawInput {
public:
    RawInput() : is_on_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
        termios raw = before_;
        raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        raw.c_cc[VMIN] = 0;
        raw.c_cc[VTIME] = 0;
        is_on_ = is_on_ && ::tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
    }
    ~RawInput() {
        if (is_on_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    }
    RawInput(const RawInput&) = delete;
    RawInput& operator=(const RawInput&) = delete;

    bool is_on() const { return is_on_; }

private:
    termios before_{};
    bool is_on_;
};

/// Sends a query, and returns everything that the terminal sends until it has listed its features.
/// Waits for at most one second.
std::string answers_to(const Stream& out, const std::string& query) {
    using Clock = std::chrono::steady_clock;
    constexpr std::size_t longest = 4096;
    const auto end = Clock::now() + std::chrono::seconds(1);
    std::string text;
    if (!out.write(query)) return text;
    while (!has_answered(text) && text.size() < longest) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (left <= 0 || ::poll(&input, 1, static_cast<int>(left)) <= 0) return text;
        char bytes[256];
        const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
        if (count <= 0) return text;
        text.append(bytes, static_cast<std::size_t>(count));
    }
    return text;
}

/// Whether the user has typed anything that is still unread. It would be mixed with the terminal's
/// answers.
bool has_input() {
    int waiting = 0;
    return ::ioctl(STDIN_FILENO, FIONREAD, &waiting) != 0 || waiting > 0;
}

/// Whether the terminal may be asked about kitty's pictures. tmux and screen do not support them
/// and do not always ignore the query. Some other terminals print queries that they do not support.
bool may_ask_for_kitty() {
    const std::string_view terminal = variable("TERM");
    return variable("TMUX").empty() && variable("STY").empty() && !terminal.starts_with("tmux") &&
           !terminal.starts_with("screen") && terminal != "linux" &&
           variable("TERM_PROGRAM") != "Apple_Terminal";
}

/// Scales a picture to the largest size that fits into `width` × `height` pixels. Enlarges it by an
/// integer of at most `most_enlarged`, or reduces it by averaging.
Image fitted(const Image& image, std::int64_t width, std::int64_t height, int most_enlarged) {
    const std::int64_t fitting = std::min(width / image.width, height / image.height);
    if (fitting >= 1) {
        return enlarge(image, static_cast<int>(std::min<std::int64_t>(fitting, most_enlarged)));
    }
    return reduce(image, std::clamp<std::int64_t>(height * image.width / image.height, 1, width));
}

}  // namespace

TerminalPictures understood(std::string_view answers) {
    TerminalPictures pictures;
    if (const auto list = sequence(answers, "\x1b[?", 'c')) {
        const auto numbers = numbers_in(*list);
        if (std::find(numbers.begin(), numbers.end(), 4) != numbers.end()) {
            pictures.protocol = PictureProtocol::sixel;
        }
    }
    if (answers.find("\x1b_Gi=31;OK\x1b\\") != std::string_view::npos) {
        pictures.protocol = PictureProtocol::kitty;
    }
    const auto size = sequence(answers, "\x1b[", 't');
    const auto numbers = size ? numbers_in(*size) : std::vector<int>();
    if (numbers.size() == 3 && numbers[0] == 6 && numbers[1] > 0 && numbers[2] > 0) {
        pictures.cell_height = numbers[1];
        pictures.cell_width = numbers[2];
    }
    return pictures;
}

TerminalPictures ask_terminal(const Stream& out) {
    TerminalPictures pictures;
    if (!out.colour || ::isatty(STDIN_FILENO) != 1) return pictures;
    const std::string_view forced = variable("CASCADE_PICTURES");
    if (forced != "characters" && !has_input()) {
        const RawInput raw;
        if (!raw.is_on()) return pictures;
        std::string query(cell_size);
        const bool asks_for_kitty = forced.empty() && may_ask_for_kitty();
        if (asks_for_kitty) query += kitty;
        query += features;
        query += erase_line;
        pictures = understood(answers_to(out, query));
    }
    if (forced == "kitty") pictures.protocol = PictureProtocol::kitty;
    if (forced == "sixel") pictures.protocol = PictureProtocol::sixel;
    if (forced == "characters") pictures.protocol = PictureProtocol::characters;
    return pictures;
}

std::string TerminalPictures::draw(const Image& image, const Stream& out,
                                   std::optional<std::uint32_t> id) const {
    constexpr int lines_around = 3;  // Lines for the prompt and for the text about the picture.
    const int rows = std::max(out.rows() - lines_around, 1);
    if (image.width < 1 || image.height < 1) return "";
    if (!out.colour) return plain_characters(image, out.columns());
    if (protocol == PictureProtocol::characters) {
        const std::int64_t fitting = image.width * 2 * rows / image.height;
        return half_blocks(image,
                           static_cast<int>(std::clamp<std::int64_t>(fitting, 1, out.columns())));
    }
    const Image shown = fitted(image, std::int64_t{out.columns()} * cell_width,
                               std::int64_t{rows} * cell_height, std::max(cell_height / 2, 1));
    const auto lines = static_cast<std::size_t>((shown.height + cell_height - 1) / cell_height);
    // The lines are made first, so that the window scrolls before the picture is drawn. The
    // position of the cursor is saved, because terminals differ in where they leave the cursor
    // after sixels.
    return fmt::format(
        "{}\x1b[{}A\x1b"
        "7{}\x1b"
        "8\x1b[{}B",
        std::string(lines, '\n'), lines,
        protocol == PictureProtocol::kitty ? kitty_picture(shown, id) : sixel_picture(shown),
        lines);
}

std::string TerminalPictures::erase(std::int64_t lines, std::uint32_t id) const {
    const std::string up = fmt::format("\x1b[{}A\x1b[J", lines);
    return protocol == PictureProtocol::kitty ? without_kitty_picture(id) + up : up;
}

}  // namespace cascade
