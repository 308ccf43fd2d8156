// Planes are written to an unnamed temporary file and painted after the run.
#include "run/pictures/frames.h"

#include "run/pictures/frame_folder.h"

#include <algorithm>
#include <cstdio>

namespace cascade {

namespace {

std::size_t plane_size(const PlaneLayout& layout) {
    return static_cast<std::size_t>(layout.size());
}

/// The whole plane including halo and padding, which is contiguous.
const float* storage(const Field& field) { return field.origin() - field.layout().offset(0, 0); }
float* storage(Field& field) { return field.origin() - field.layout().offset(0, 0); }

}  // namespace

Result<FrameRecorder> FrameRecorder::create(const std::filesystem::path& folder, bool space_time) {
    FrameRecorder recorder;
    recorder.folder_ = folder;
    recorder.keep_rows_ = space_time;
    if (folder.empty()) return recorder;
    recorder.file_.reset(std::tmpfile());
    if (!recorder.file_) {
        return cascade::failure("no temporary file can be made for the frames",
                                "is the folder for temporary files full?");
    }
    return recorder;
}

void FrameRecorder::record(const Canvas& canvas, const std::string& stage, std::int64_t step) {
    if (failure_) return;
    layout_ = canvas.fields[0].layout();
    if (const Field* number = canvas.number()) values_.add(spread_of(*number));
    frames_.push_back({stage, step, canvas.fields.size(), !canvas.relief.empty()});
    if (file_) {
        bool is_kept = true;
        for (const Field& field : canvas.fields) is_kept = is_kept && keep(field);
        if (!canvas.relief.empty()) is_kept = is_kept && keep(canvas.relief);
        if (!is_kept) {
            failure_ = Failure{"the frames do not fit into the folder for temporary files",
                               "ask for a larger interval"};
            return;
        }
    }
    if (keep_rows_) {
        Canvas copy;
        for (const Field& field : canvas.fields) copy.fields.push_back(field.clone());
        rows_.push_back(std::move(copy));
    }
}

bool FrameRecorder::holds_starts_alone() const {
    return std::all_of(frames_.begin(), frames_.end(),
                       [](const Frame& frame) { return frame.step == 0; });
}

bool FrameRecorder::keep(const Field& field) {
    const std::size_t count = plane_size(layout_);
    return std::fwrite(storage(field), sizeof(float), count, file_.get()) == count;
}

Result<Canvas> FrameRecorder::read_back(const Frame& frame) {
    Canvas canvas;
    for (std::size_t plane = 0; plane < frame.planes + (frame.has_relief ? 1 : 0); ++plane) {
        Field field(layout_);
        const std::size_t count = plane_size(layout_);
        if (std::fread(storage(field), sizeof(float), count, file_.get()) != count) {
            return cascade::failure("the frames cannot be read back");
        }
        if (plane < frame.planes) canvas.fields.push_back(std::move(field));
        else canvas.relief = std::move(field);
    }
    return canvas;
}

Result<std::vector<std::filesystem::path>> FrameRecorder::write(Painter& painter, PngDepth depth,
                                                                const PngTexts& texts) {
    std::vector<std::filesystem::path> written;
    std::rewind(file_.get());
    for (std::size_t number = 0; number < frames_.size(); ++number) {
        const Frame& frame = frames_[number];
        auto canvas = read_back(frame);
        if (!canvas) return tl::unexpected(canvas.error());
        const auto path = folder_ / frame_name(number, frame.stage, frame.step);
        if (auto done = write_png(path, painter.image(*canvas, automatic_range(values_)), depth,
                                  texts, PngEffort::fast);
            !done) {
            return tl::unexpected(done.error());
        }
        written.push_back(path);
    }
    return written;
}

Image FrameRecorder::space_time(Painter& painter) const {
    Image whole(0, 0);
    for (const Canvas& row : rows_) {
        const Image image = painter.image(row, automatic_range(values_));
        whole.width = image.width;
        whole.height += image.height;
        whole.pixels.insert(whole.pixels.end(), image.pixels.begin(), image.pixels.end());
    }
    return whole;
}

}  // namespace cascade
