// Files that are not what their name says, cut files, and files with peculiarities of the programs
// that wrote them. Each file is read, or refused with the reason.
#include "built_gltf.h"
#include "mesh/model_file.h"
#include "support/small_models.h"

#include <gmock/gmock.h>

namespace cascade::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// "read", or the message with its hint.
std::string answer(const Result<PolygonSoup>& result) {
    if (result) return "read";
    const Failure& fault = result.error();
    return fault.hint.empty() ? fault.message : fault.message + " | " + fault.hint;
}

std::string answer_to(std::string_view bytes, std::string_view ending) {
    return answer(read_model_bytes(bytes, ending));
}

constexpr std::string_view ply_of_a_triangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string with(std::string_view text, std::string_view from, std::string_view to) {
    std::string changed(text);
    return changed.replace(changed.find(from), from.size(), to);
}

TEST(OddFiles, WhatIsNoModelIsNamed) {
    for (const char* ending : {"ply", "obj", "off", "stl", "gltf", "glb"}) {
        EXPECT_EQ(answer_to("", ending), "the file is empty");
        EXPECT_EQ(answer_to("<!DOCTYPE html><html>404</html>", ending),
                  "the file is a page of HTML | the download of the model has failed");
        EXPECT_EQ(answer_to("version https://git-lfs.github.com/spec/v1\noid sha256:0", ending),
                  "the file is a pointer of Git LFS, without the model | "
                  "'git lfs pull' fetches the model");
        EXPECT_EQ(answer_to("\x1f\x8b\x08", ending),
                  "the file is compressed by gzip | unpack it first");
        EXPECT_EQ(answer_to("PK\x03\x04 and more", ending),
                  "the file is a ZIP archive | unpack it first");
    }
    EXPECT_EQ(answer_to(ply_of_a_triangle, "obj"),
              "this is a PLY file, but its name ends in .obj | rename the file so that its name "
              "ends in .ply");
    EXPECT_EQ(answer_to(BuiltGltf().bytes(), "stl"),
              "this is a GLB file, but its name ends in .stl | rename the file so that its name "
              "ends in .glb");
    EXPECT_EQ(answer_to(BuiltGltf().bytes(), "gltf"), "read");
}

TEST(OddFiles, CutGlbFilesSayHowShortTheyAre) {
    const std::string whole = BuiltGltf().bytes();
    ASSERT_EQ(answer_to(whole, "glb"), "read");
    for (std::size_t size = 8; size < whole.size(); size += 7) {
        const std::string cut = answer_to(std::string_view(whole).substr(0, size), "glb");
        const std::size_t told = size < 12 ? 12 : whole.size();
        EXPECT_EQ(cut, fmt::format("the GLB file is {} bytes long, but it has at least {} | "
                                   "it may be truncated",
                                   size, told));
    }
    EXPECT_EQ(answer_to(whole + "more", "glb"), "read");
}

TEST(OddFiles, MessagesAboutGltfQuoteNoData) {
    BuiltGltf file;
    file.bytes();
    file.json["buffers"][0]["byteLength"] = 5000;
    file.json["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + std::string(4000, 'A');
    const std::string text = answer_to(file.json.dump(), "gltf");
    EXPECT_EQ(text,
              "this is not a glTF file that can be read | the data of a buffer are not Base64, or "
              "not as long as its byteLength");
    file.json["buffers"][0]["uri"] = "https://example.org/a.bin";
    EXPECT_EQ(
        answer_to(file.json.dump(), "gltf"),
        "the glTF file has its data at 'https://example.org/a.bin' | only files beside the glTF "
        "file can be read: download this file and name it in 'uri'");
}

TEST(OddFiles, GltfFilesOfPointsOrLines) {
    for (const int mode : {0, 1, 2, 3}) {
        BuiltGltf file;
        file.primitive()["mode"] = mode;
        EXPECT_EQ(answer(file.read()),
                  "the glTF file contains only points or lines | export a surface of triangles");
    }
    for (const int mode : {4, 5, 6}) {
        BuiltGltf file;
        file.primitive()["mode"] = mode;
        EXPECT_EQ(answer(file.read()), "read") << mode;
    }
}

TEST(OddFiles, PlyFilesWhoseHeaderIsWrong) {
    EXPECT_EQ(answer_to(ply_of_a_triangle, "ply"), "read");
    const std::string more =
        "the PLY file has more numbers than its header says | "
        "the header counts too few elements, or a property is missing there";
    EXPECT_EQ(answer_to(with(ply_of_a_triangle, "0 1 0\n", "0 1 0\n5 5 5\n"), "ply"), more);
    EXPECT_EQ(answer_to(std::string(ply_of_a_triangle) + "3 0 2 1\n", "ply"), more);
    EXPECT_EQ(answer_to(std::string(ply_of_a_triangle) + " \r\n\t\n", "ply"), "read");
    EXPECT_EQ(answer_to(with(ply_of_a_triangle, "vertex_indices", "vertices"), "ply"),
              "the faces of the PLY file have no list 'vertex_indices' | "
              "their list is called 'vertices'");
}

TEST(OddFiles, PlyFilesOfOldMacintoshPrograms) {
    std::string text(ply_of_a_triangle);
    std::replace(text.begin(), text.end(), '\n', '\r');
    EXPECT_EQ(answer_to(text, "ply"), "read");
    // After a header with such line ends, bytes of binary numbers may be line feeds.
    std::string binary = with(text, "ascii", "binary_little_endian");
    binary.resize(binary.find("end_header") + std::string("end_header\r").size());
    for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
        binary += bytes_of(number, false);
    binary[binary.find("end_header") + std::string("end_header\r").size()] = '\n';
    binary += '\3';
    for (const std::uint32_t corner : {0u, 1u, 2u}) binary += bytes_of(corner, false);
    EXPECT_EQ(answer_to(binary, "ply"), "read");
}

TEST(OddFiles, ObjFilesOfOtherHabits) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_EQ(answer_to(points + "f 0 1 2\n", "obj"),
              "line 4 of the OBJ file is not a face of points | points are counted from 1");
    EXPECT_EQ(answer_to("v 0,5 0,0 0,0\n", "obj"),
              "line 1 of the OBJ file is not the position of a point | "
              "write numbers with a point, not with a comma");
    EXPECT_EQ(answer_to("v 0 0\n", "obj"),
              "line 1 of the OBJ file is not the position of a point | "
              "write three coordinates for each point");
    EXPECT_EQ(answer_to(points + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 3\nend\n", "obj"),
              "the OBJ file contains only curved surfaces, which Cascade cannot read | export it "
              "as triangles");
    EXPECT_EQ(answer_to(points + "l 1 2\np 1\nf 1 2 3\n", "obj"), "read");
}

}  // namespace
}  // namespace cascade::test
