// Reads lines from a pipe or a file in blocks. The last line may lack a newline.
#include "app/line_reader.h"

#include <cerrno>
#include <unistd.h>

namespace cascade {

namespace {

class PlainReader : public LineReader {
public:
    explicit PlainReader(int descriptor) : descriptor_(descriptor) {}

    TypedLine read(const std::string&) override {
        std::size_t searched = 0;
        while (true) {
            const std::size_t end = waiting_.find('\n', searched);
            if (end != std::string::npos) return take(end, end + 1);
            searched = waiting_.size();
            if (!read_more()) break;
        }
        if (waiting_.empty()) return {};
        return take(waiting_.size(), waiting_.size());
    }

private:
    TypedLine take(std::size_t end, std::size_t next) {
        TypedLine line{TypedLine::Kind::line, waiting_.substr(0, end)};
        if (line.text.ends_with('\r')) line.text.pop_back();
        waiting_.erase(0, next);
        return line;
    }

    bool read_more() {
        char piece[4096];
        ssize_t count = 0;
        do {
            count = ::read(descriptor_, piece, sizeof piece);
        } while (count < 0 && errno == EINTR);
        if (count <= 0) return false;
        waiting_.append(piece, static_cast<std::size_t>(count));
        return true;
    }

    int descriptor_;
    std::string waiting_;
};

}  // namespace

std::unique_ptr<LineReader> make_plain_reader(int descriptor) {
    return std::make_unique<PlainReader>(descriptor);
}

}  // namespace cascade
