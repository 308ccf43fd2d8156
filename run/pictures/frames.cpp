// Writes planes to an unnamed temporary file, and paints them after the run, when the range of all
// values is known.
#include "run/pictures/frames.h"

#include "core/enough_memory.h"
#include "core/parallel.h"
#include "core/run_control.h"
#include "core/write_encoded.h"
#include "picture/caption.h"
#include "run/domain/free_memory.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/frame_folder.h"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <type_traits>

namespace cascade {

namespace {

std::size_t plane_size(const PlaneLayout& layout) {
    return static_cast<std::size_t>(layout.size());
}

/// Returns the beginning of a plane's memory. This memory is contiguous and includes the halo and
/// the padding of rows.
const float* storage(const Field& field) { return field.origin() - field.layout().offset(0, 0); }
float* storage(Field& field) { return field.origin() - field.layout().offset(0, 0); }

/// Returns the last of `planes` if it has this layout, and a new plane if not. Removes the plane
/// from `planes`.
Field reused_plane(const PlaneLayout& layout, std::vector<Field>& planes) {
    if (planes.empty()) return Field(layout);
    Field plane = std::move(planes.back());
    planes.pop_back();
    return plane.layout() == layout ? std::move(plane) : Field(layout);
}

}  // namespace

Result<FrameRecorder> FrameRecorder::create(bool keep_values, bool space_time) {
    FrameRecorder recorder;
    recorder.keep_rows_ = space_time;
    if (!keep_values) return recorder;
    recorder.file_.reset(std::tmpfile());
    if (!recorder.file_) {
        return cascade::failure("no temporary file can be made for the frames",
                                "is the folder for temporary files full?");
    }
    return recorder;
}

void FrameRecorder::record(const Canvas& canvas, const std::string& stage, std::int64_t step,
                           std::string label) {
    if (failure_) return;
    const PlaneLayout layout = canvas.fields[0].layout();
    if (const Field* number = canvas.number()) values_.add(spread_of(*number));
    for (std::size_t axis = 0; axis < largest_.size(); ++axis)
        largest_[axis] = std::max(largest_[axis], canvas.scales[axis]);
    frames_.push_back({canvas.scales,
                       stage,
                       step,
                       std::move(label),
                       canvas.fields.size(),
                       {},
                       layout,
                       kept_,
                       canvas.cells});
    if (file_) {
        bool is_kept = true;
        for (const Field& field : canvas.fields) is_kept = is_kept && keep(field);
        const auto extras = extra_planes(canvas);
        for (std::size_t k = 0; k < extras.size(); ++k) {
            if (extras[k]->empty()) continue;
            frames_.back().extras.set(k);
            is_kept = is_kept && keep(*extras[k]);
        }
        if (canvas.cells) is_kept = is_kept && keep_cells(*canvas.cells, frames_.back());
        if (canvas.body) is_kept = is_kept && keep_body(*canvas.body, frames_.back());
        if (!is_kept) {
            failure_ = Failure{"the frames do not fit into the folder for temporary files",
                               "use a larger 'interval'"};
            return;
        }
    }
    if (keep_rows_) {
        Canvas copy;
        for (const Field& field : canvas.fields) copy.fields.push_back(field.clone());
        rows_.push_back(std::move(copy));
    }
}

bool FrameRecorder::shows_cells() const {
    return std::ranges::any_of(frames_, [](const Frame& frame) { return frame.cells != nullptr; });
}

bool FrameRecorder::holds_starts_alone() const {
    return std::all_of(frames_.begin(), frames_.end(),
                       [](const Frame& frame) { return frame.step == 0; });
}

bool FrameRecorder::keep(const Field& field) {
    const std::size_t count = plane_size(field.layout());
    kept_ += static_cast<std::int64_t>(count * sizeof(float));
    return std::fwrite(storage(field), sizeof(float), count, file_.get()) == count;
}

template <typename T>
bool FrameRecorder::keep_items(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T>);
    kept_ += static_cast<std::int64_t>(items.size() * sizeof(T));
    return std::fwrite(items.data(), sizeof(T), items.size(), file_.get()) == items.size();
}

template <typename T>
bool FrameRecorder::read_items(std::vector<T>& items, std::size_t count) {
    items.resize(count);
    return std::fread(items.data(), sizeof(T), count, file_.get()) == count;
}

bool FrameRecorder::keep_cells(const DrawnCells& cells, Frame& frame) {
    auto rest = std::make_shared<DrawnCells>(cells);
    frame.placements = rest->placements.size();
    frame.colours = rest->body_colours.size();
    const bool is_kept =
        keep_items(rest->placements) && keep_items(rest->cells) && keep_items(rest->body_colours);
    rest->placements = {};
    rest->cells = {};
    rest->body_colours = {};
    frame.cells = std::move(rest);
    return is_kept;
}

bool FrameRecorder::keep_body(const SurfaceMesh& body, Frame& frame) {
    frame.has_body = true;
    frame.points = body.points.size();
    frame.triangles = body.triangles.size();
    return keep_items(body.points) && keep_items(body.triangles) && keep_items(body.across);
}

Result<Canvas> FrameRecorder::read_back(const Frame& frame, std::vector<Field> planes) {
    Canvas canvas;
    canvas.scales = frame.scales;
    canvas.cells = frame.cells;
    if (::fseeko(file_.get(), frame.place, SEEK_SET) != 0) {
        return cascade::failure("the frames cannot be read back");
    }
    bool is_read = true;
    const auto next = [&] {
        Field field = reused_plane(frame.layout, planes);
        const std::size_t count = plane_size(frame.layout);
        is_read = is_read && std::fread(storage(field), sizeof(float), count, file_.get()) == count;
        return field;
    };
    for (std::size_t plane = 0; plane < frame.planes; ++plane) canvas.fields.push_back(next());
    const auto extras = extra_planes(canvas);
    for (std::size_t k = 0; k < extras.size(); ++k) {
        if (frame.extras[k]) *extras[k] = next();
    }
    if (frame.has_body) {
        auto body = std::make_shared<SurfaceMesh>();
        is_read = is_read && read_items(body->points, frame.points) &&
                  read_items(body->triangles, frame.triangles) &&
                  read_items(body->across, frame.triangles);
        canvas.body = std::move(body);
    }
    if (!is_read) return cascade::failure("the frames cannot be read back");
    if (!frame.cells) return canvas;
    auto cells = std::make_shared<DrawnCells>(*frame.cells);
    if (!read_items(cells->placements, frame.placements) ||
        !read_items(cells->cells, frame.placements) ||
        !read_items(cells->body_colours, frame.colours)) {
        return cascade::failure("the frames cannot be read back");
    }
    canvas.cells = std::move(cells);
    return canvas;
}

/// Returns the number of threads whose data fit into half of the free memory, at most `threads`.
/// Each thread needs a picture and the input of its encoder.
int FrameRecorder::threads_for(const Painter& painter, int threads) const {
    // A picture of a surface, or a smooth picture, is drawn by all threads together, so only one
    // picture is drawn at a time.
    if (frames_.empty() || !painter.has_square_cells() || shows_cells()) return 1;
    constexpr std::uint64_t bytes_of_pixel = 40;
    const auto [across, down] = painter.request().copies;
    const std::int64_t scale = painter.request().scale;
    const PlaneLayout& layout = frames_.front().layout;
    const auto pixels =
        static_cast<std::uint64_t>(layout.width * layout.height * scale * scale * across * down);
    const std::uint64_t fitting = available_memory() / 2 / (pixels * bytes_of_pixel);
    const std::uint64_t most =
        std::min<std::uint64_t>(static_cast<unsigned>(threads), frames_.size());
    return static_cast<int>(std::clamp<std::uint64_t>(fitting, 1, most));
}

Result<void> FrameRecorder::use_canvases(std::span<const std::size_t> numbers, int threads,
                                         const std::atomic<bool>& cancel, const UseCanvas& use) {
    std::mutex mutex;  // Protects the variables below and the file.
    std::condition_variable is_done;
    std::size_t begun = 0, done = 0;
    std::optional<Failure> failed;
    const auto work = [&](int) {
        std::unique_lock lock(mutex);
        std::vector<Field> planes;  // Planes whose memory the next frame uses again.
        Image image;
        while (!failed && !cancel && begun < numbers.size()) {
            const std::size_t turn = begun++;
            const std::size_t number = numbers[turn];
            Result<Canvas> canvas =
                enough_memory_for([&] { return read_back(frames_[number], std::move(planes)); });
            lock.unlock();
            Result<InOrder> finish = enough_memory_for([&]() -> Result<InOrder> {
                if (!canvas) return tl::unexpected(canvas.error());
                auto used = use(number, *canvas, image);
                planes = std::move(canvas->fields);
                return used;
            });
            lock.lock();
            is_done.wait(lock, [&] { return failed || done == turn; });
            if (failed) return;
            lock.unlock();
            const Result<void> finished =
                finish.and_then([](const InOrder& rest) { return enough_memory_for(rest); });
            lock.lock();
            if (finished) ++done;
            else failed = finished.error();
            is_done.notify_all();
        }
    };
    Team(threads).run(work);
    if (failed) return tl::unexpected(*failed);
    return {};
}

void FrameRecorder::draw_one(Painter& painter, std::size_t number, const Canvas& canvas,
                             Image& image) const {
    // A film shows how a surface or body grows: it fills the picture when it is largest.
    const View view = painter.request().view;
    if (!painter.is_flat()) {
        View far = view;
        far.zoom = static_cast<float>(canvas.scales[0] / largest_[0]);
        painter.set_view(far);
    }
    // All frames of a film must have the same size, so frames without cells get the size of frames
    // with cells.
    image = shows_cells() ? painter.image_beside_cells(canvas, range())
                          : painter.image(canvas, range(), std::move(image));
    if (painter.is_flat()) image = in_largest(image, canvas.scales, largest_);
    else painter.set_view(view);
    const std::string& label = frames_[number].label;
    if (!label.empty() && has_room_for_caption(image.width, image.height)) {
        draw_caption(image, label);
    }
}

Result<void> FrameRecorder::draw(Painter& painter, std::span<const std::size_t> numbers,
                                 int threads, const std::atomic<bool>& cancel,
                                 const UseImage& use) {
    return use_canvases(numbers, threads_for(painter, threads), cancel,
                        [&](std::size_t number, const Canvas& canvas, Image& image) {
                            draw_one(painter, number, canvas, image);
                            return use(number, image);
                        });
}

Result<std::vector<std::filesystem::path>> FrameRecorder::write(const std::filesystem::path& folder,
                                                                Painter& painter,
                                                                const PngTexts& texts, int threads,
                                                                const std::atomic<bool>& cancel) {
    std::vector<std::size_t> all(frames_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<std::filesystem::path> written;
    const auto encoded = [&](const auto& picture) {
        return encode_png(picture, painter.request().png_depth(), texts, PngMeaning::colours,
                          PngEffort::fast);
    };
    const auto encode = [&](std::size_t number, const Canvas& canvas, Image& image) {
        const auto painting = shows_cells() ? std::nullopt : painter.painting(canvas, range());
        const bool is_grey = painting && painting->has_two_greys();
        if (is_grey && frames_[number].label.empty()) return encoded(*painting);
        draw_one(painter, number, canvas, image);
        return encoded(image);
    };
    const auto use = [&](std::size_t number, const Canvas& canvas,
                         Image& image) -> Result<InOrder> {
        const Frame& frame = frames_[number];
        const auto path = folder / frame_name(number, frame.stage, frame.step);
        auto bytes = encode(number, canvas, image);
        return [&written, path, bytes = std::move(bytes)]() -> Result<void> {
            auto done = write_encoded(path, [&] { return bytes; });
            if (done) written.push_back(path);
            return done;
        };
    };
    auto drawn = use_canvases(all, threads_for(painter, threads), cancel, use);
    if (!drawn) return tl::unexpected(drawn.error());
    return written;
}

Image FrameRecorder::space_time(Painter& painter) const {
    Image whole(0, 0);
    for (const Canvas& row : rows_) {
        const Image image = painter.image(row, range());
        whole.width = image.width;
        whole.height += image.height;
        whole.pixels.insert(whole.pixels.end(), image.pixels.begin(), image.pixels.end());
    }
    return whole;
}

}  // namespace cascade
