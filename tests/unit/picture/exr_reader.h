// OpenEXR files, read by the library's C++ classes.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade::test {

struct ReadExr {
    std::vector<std::string> names, half;
    int width = 0, height = 0;
    std::vector<std::vector<float>> numbers;  ///< By channel.
};

/// Reads a file with one part.
inline ReadExr read_exr(const std::filesystem::path& path) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    ReadExr read;
    read.width = window.max.x - window.min.x + 1;
    read.height = window.max.y - window.min.y + 1;
    const Imf::ChannelList& channels = file.header().channels();
    const auto count = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
    Imf::FrameBuffer buffer;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        read.names.emplace_back(channel.name());
        if (channel.channel().type == Imf::HALF) read.half.emplace_back(channel.name());
        read.numbers.emplace_back(count);
    }
    for (std::size_t k = 0; k < read.names.size(); ++k) {
        buffer.insert(read.names[k],
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.numbers[k].data()),
                                 sizeof(float),
                                 sizeof(float) * static_cast<std::size_t>(read.width)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(0, read.height - 1);
    return read;
}

}  // namespace cascade::test
