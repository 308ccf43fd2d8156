// Reads glTF and GLB files with tinygltf, whose code is compiled in this file.
#include "core/printable.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_requirements.h"
#include "mesh/gltf_scene.h"
#include "mesh/model_file.h"

#define TINYGLTF_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop
#undef TINYGLTF_IMPLEMENTATION

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace cascade {

namespace {

/// A little-endian number of four bytes.
std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t k = 4; k-- > 0;)
        number = number << 8 | static_cast<unsigned char>(bytes[at + k]);
    return number;
}

/// Fails if a binary file is shorter than the length in its header, at byte 8.
Result<void> check_whole(std::string_view bytes) {
    constexpr std::size_t header = 12;
    const std::size_t length = bytes.size() < header ? header : number_at(bytes, 8);
    if (bytes.size() >= length) return {};
    return failure(fmt::format("the GLB file is {} bytes long, but it has at least {}",
                               bytes.size(), length),
                   "it may be truncated");
}

/// An error message of tinygltf. If the message quotes the data of a buffer, returns another
/// message without the data.
std::string without_data(std::string fault) {
    const std::size_t data = fault.find("data:");
    if (data == std::string::npos) return short_name(fault, 400);
    return "the data of a buffer are not Base64, or not as long as its byteLength";
}

/// The JSON text of a binary file. The text begins at byte 20, and its length is at byte 12.
std::string_view json_of(std::string_view bytes, bool is_binary) {
    if (!is_binary || bytes.size() < 20) return bytes;
    return bytes.substr(20, number_at(bytes, 12));
}

/// Callbacks for reading external buffers. tinygltf's own callbacks open any file and use a shell.
class Buffers {
public:
    explicit Buffers(const GrantedFiles& files) : files_(files) {}

    tinygltf::FsCallbacks callbacks() {
        tinygltf::FsCallbacks calls{};
        // Returns true for missing files, too, because reading them will fail later.
        calls.FileExists = [](const std::string&, void*) { return true; };
        calls.ExpandFilePath = [](const std::string& name, void*) { return name; };
        calls.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*,
                                 const std::string& name, void* self) {
            return static_cast<Buffers*>(self)->read(name, *out);
        };
        calls.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
        calls.user_data = this;
        return calls;
    }

    /// The reason why a buffer could not be read.
    const std::optional<Failure>& failure() const { return failure_; }

private:
    bool read(const std::string& name, std::vector<unsigned char>& out) {
        if (name.find("://") != std::string::npos) {
            const Result<void> remote = cascade::failure(
                fmt::format("the glTF file has its data at '{}'", short_name(name)),
                "only files beside the glTF file can be read: download this file and name it in "
                "'uri'");
            failure_ = remote.error();
            return false;
        }
        const Result<std::string> bytes = files_.read(name, largest_model_file);
        if (!bytes) failure_ = bytes.error();
        else out.assign(bytes->begin(), bytes->end());
        return bytes.has_value();
    }

    const GrantedFiles& files_;
    std::optional<Failure> failure_;
};

bool load(std::string_view bytes, bool is_binary, Buffers& buffers, tinygltf::Model& model,
          std::string& fault) {
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    reader.SetFsCallbacks(buffers.callbacks());
    std::string warning;
    const auto size = static_cast<unsigned>(bytes.size());
    try {  // An empty buffer makes the library throw std::out_of_range.
        return is_binary
                   ? reader.LoadBinaryFromMemory(
                         &model, &fault, &warning,
                         reinterpret_cast<const unsigned char*>(bytes.data()), size)
                   : reader.LoadASCIIFromString(&model, &fault, &warning, bytes.data(), size, "");
    } catch (const std::logic_error& error) {
        fault = error.what();
        return false;
    }
}

/// Whether the file has parts of meshes and all of them consist of points or lines.
bool has_lines_only(const tinygltf::Model& model) {
    bool has_parts = false;
    for (const tinygltf::Mesh& mesh : model.meshes) {
        for (const tinygltf::Primitive& part : mesh.primitives) {
            has_parts = true;
            if (part.mode < 0 || part.mode >= TINYGLTF_MODE_TRIANGLES) return false;
        }
    }
    return has_parts;
}

}  // namespace

Result<PolygonSoup> read_gltf(std::string_view bytes, const GrantedFiles& files) {
    const bool is_binary = bytes.starts_with("glTF");
    if (bytes.size() > std::numeric_limits<unsigned>::max())
        return failure("the glTF file is too large");
    if (is_binary && bytes.size() >= 8 && bytes[4] == 1 &&
        bytes.substr(5, 3) == std::string(3, '\0')) {
        return failure("this is a GLB file of version 1, but only version 2 can be read",
                       "export it as version 2, which most modelling programs can write");
    }
    if (is_binary) {
        if (auto whole = check_whole(bytes); !whole) return tl::unexpected(whole.error());
    }
    const std::string_view json = json_of(bytes, is_binary);
    if (auto good = check_gltf_size(json); !good) return tl::unexpected(good.error());
    if (auto good = check_gltf_requirements(json); !good) return tl::unexpected(good.error());
    tinygltf::Model model;
    std::string fault;
    Buffers buffers(files);
    if (!load(bytes, is_binary, buffers, model, fault)) {
        if (buffers.failure()) return tl::unexpected(*buffers.failure());
        while (fault.ends_with('\n')) fault.pop_back();
        std::replace(fault.begin(), fault.end(), '\n', ' ');
        return failure("this is not a glTF file that can be read", without_data(std::move(fault)));
    }
    if (has_lines_only(model)) {
        return failure("the glTF file contains only points or lines",
                       "export a surface of "
                       "triangles");
    }
    std::size_t size = bytes.size();
    for (const tinygltf::Buffer& buffer : model.buffers) size += buffer.data.size();
    return read_gltf_scene(model, size);
}

}  // namespace cascade
