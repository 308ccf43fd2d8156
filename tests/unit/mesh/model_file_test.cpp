// Files of each format as written by programs, and broken files.
#include "mesh/model_file.h"

#include "support/small_models.h"
#include "unit/mesh/soups.h"

#include <gmock/gmock.h>

#include <bit>
#include <cstring>
#include <fstream>

namespace cascade {
namespace {

using test::bytes_of;
using test::gltf_text;
using testing::ElementsAre;
using testing::HasSubstr;

std::string fault_of(const Result<PolygonSoup>& result) {
    return result ? "read" : result.error().message;
}

constexpr std::string_view text_ply = R"(ply
format ascii 1.0
comment two triangles and a strip
element vertex 5
property float x
property float y
property double z
property uchar red
property float quality
element face 1
property uchar flags
property list uchar int vertex_indices
property list uchar float texcoord
element tristrips 1
property list int int vertex_indices
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255 1
1 0 0 0 2
1 1 0 0 3
0 1 0.5 0 4
2 2 2 7 5
9 4 0 1 2 3 8 0 0 1 0 1 1 0 1
8 0 1 2 3 -1 4 2 1
0 1
)";

TEST(ModelFile, APlyFileOfText) {
    const auto soup = read_ply(text_ply);
    ASSERT_TRUE(soup) << fault_of(soup);
    EXPECT_EQ(soup->points.size(), 5u);
    EXPECT_EQ(soup->points[3], (Vector3d{0, 1, 0.5}));
    ASSERT_EQ(soup->polygon_count(), 4u);
    EXPECT_THAT(soup->polygon(0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(soup->polygon(1), ElementsAre(0, 1, 2));
    EXPECT_THAT(soup->polygon(2), ElementsAre(2, 1, 3));
    EXPECT_THAT(soup->polygon(3), ElementsAre(4, 2, 1));
    EXPECT_TRUE(soup->texture.empty());  // The strips have no texture coordinates.
    ASSERT_EQ(soup->attributes.size(), 2u);
    EXPECT_EQ(soup->attributes[0].name, "red");
    EXPECT_THAT(soup->attributes[1].values, ElementsAre(1, 2, 3, 4, 5));
}

TEST(ModelFile, PlyFilesOfBothByteOrders) {
    for (const bool big : {false, true}) {
        std::string file = "ply\nformat ";
        file += big ? "binary_big_endian" : "binary_little_endian";
        file +=
            " 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n"
            "property float s\nproperty float t\n"
            "element face 1\nproperty list uint8 uint16 vertex_index\nend_header\n";
        for (int k = 0; k < 3; ++k) {
            file += bytes_of(static_cast<float>(k), big) + bytes_of(0.1 * k, big) +
                    bytes_of(static_cast<std::uint16_t>(-k), big) +
                    bytes_of(0.25F * static_cast<float>(k), big) + bytes_of(0.5F, big);
        }
        file += '\3';
        for (const std::uint16_t corner : std::initializer_list<std::uint16_t>{0, 2, 1})
            file += bytes_of(corner, big);
        const auto soup = read_ply(file);
        ASSERT_TRUE(soup) << fault_of(soup);
        EXPECT_EQ(soup->points[2], (Vector3d{2, 0.2, -2}));
        EXPECT_THAT(soup->polygon(0), ElementsAre(0, 2, 1));
        ASSERT_EQ(soup->texture.size(), 3u);
        EXPECT_EQ(soup->texture[1], (TexturePlace{0.5F, 0.5F}));

        for (std::size_t size = 0; size < file.size(); ++size) {
            EXPECT_FALSE(read_ply(std::string_view(file).substr(0, size))) << size;
        }
    }
}

TEST(ModelFile, BrokenPlyFiles) {
    const auto fault_with = [](std::string_view from, std::string_view to) {
        std::string text(text_ply);
        text.replace(text.find(from), from.size(), to);
        return fault_of(read_ply(text));
    };
    EXPECT_EQ(fault_with("ply\n", "pli\n"), "this is not a PLY file: it does not begin with 'ply'");
    EXPECT_EQ(fault_with("float y", "flaot y"),
              "line 6 of the PLY file's header is not understood");
    EXPECT_EQ(fault_with("end_header", ""), "line 20 of the PLY file's header is not understood");
    EXPECT_THAT(fault_with("vertex 5", "vertex 4000000000"), HasSubstr("too short for 4000000000"));
    EXPECT_THAT(fault_with("vertex 5", "vertex 18446744073709551615"), HasSubstr("too short"));
    EXPECT_EQ(fault_with("9 4 0 1 2 3", "9 4 0 1 2 7"),
              "a face names point 7, but there are only 5");
    EXPECT_THAT(fault_with("9 4 0 1 2 3", "9 4 0 1 2 -3"), HasSubstr("not the number of a point"));
    EXPECT_THAT(fault_with("9 4 0", "9 4000000000 0"), HasSubstr("ends too early"));
    EXPECT_THAT(fault_with("1 0 0 0 2", "1 0 zero 0 2"),
                HasSubstr("row 1 (counted from 0) of its element 'vertex'"));
    EXPECT_EQ(fault_with("float x", "float w"), "the points of the PLY file lack x, y or z");
}

TEST(ModelFile, AnObjFile) {
    const auto soup = read_obj(
        "mtllib /dev/zero\n"
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        "vt 0.5 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "g square\nf 1/1 2/2 3/3 4/4\nf -4/1 -3/2 -1/4\n");
    ASSERT_TRUE(soup) << fault_of(soup);
    EXPECT_EQ(soup->points.size(), 4u);
    ASSERT_EQ(soup->polygon_count(), 2u);
    EXPECT_THAT(soup->polygon(0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(soup->polygon(1), ElementsAre(0, 1, 3));
    ASSERT_EQ(soup->texture.size(), 7u);
    EXPECT_EQ(soup->texture[0], (TexturePlace{0.5F, 0}));
    EXPECT_EQ(soup->texture[6], (TexturePlace{0, 1}));

    EXPECT_EQ(fault_of(read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n")),
              "face 2 of the OBJ file names a point that does not exist");
}

TEST(ModelFile, AnOffFileAndAnStlFile) {
    const auto off = read_off(
        "COFF\n# a square\n4 2 0\n0 0 0 255 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n\n"
        "0 1 0 0 51 0\n3 0 1 2\n3 0 2 3 1 0 0\n");
    ASSERT_TRUE(off) << fault_of(off);
    EXPECT_EQ(off->points.size(), 4u);
    EXPECT_THAT(off->polygon(1), ElementsAre(0, 2, 3));
    ASSERT_EQ(off->attributes.size(), 3u);
    EXPECT_THAT(off->attributes[1].values, ElementsAre(0, 0, 0, 0.2F));
    EXPECT_TRUE(read_off("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2"));
    EXPECT_EQ(fault_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n")),
              "line 5 of the OFF file is not the position of a point");
    EXPECT_EQ(fault_of(read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")),
              "line 6 of the OFF file is not a face of these points");
    EXPECT_THAT(fault_of(read_off("OFF\n4000000000 1 0\n0 0 0\n")), HasSubstr("too short for"));
    EXPECT_EQ(fault_of(read_off("solid")), "this is not an OFF file in text form");

    const auto stl = read_stl(
        "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
        "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    ASSERT_TRUE(stl) << fault_of(stl);
    EXPECT_EQ(stl->polygon_count(), 1u);
}

TEST(ModelFile, StlTextInLinesOfAnyLength) {
    const std::string facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
    for (const char* end :
         {"endsolid part", "\nendsolid", "\n; vertex in outer space\nEndSolid\n"}) {
        const auto soup = read_stl("solid part facet\n" + facet + facet + end);
        ASSERT_TRUE(soup) << end << fault_of(soup);
        EXPECT_EQ(soup->polygon_count(), 2u) << end;
    }
    const auto in_one_line =
        read_stl("solid a part " + facet + "endsolid a part solid b " + facet + "endsolid b");
    ASSERT_TRUE(in_one_line) << fault_of(in_one_line);
    EXPECT_EQ(in_one_line->polygon_count(), 2u);
    EXPECT_EQ(fault_of(read_stl("solid\n" + facet)), "the STL file breaks off before 'endsolid'");
    EXPECT_EQ(fault_of(read_stl("solid\nouter loop vertex 0 0 vertex 1 0 0\n")),
              "line 2 of the STL file is not a corner of a triangle");
}

TEST(ModelFile, OffCountsRightAfterTheWord) {
    const std::string rest = " 1 0\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n3 0 1 2\n";
    for (const char* head : {"OFF3", "OFF 3", "OFF\n3", "STOFF3", "3"}) {
        EXPECT_EQ(fault_of(read_off(head + rest)), "read") << head;
    }
    for (const char* head : {"OFFx3", "4OFF3", "OFF3x", "OFF-3", "OF3"}) {
        EXPECT_EQ(fault_of(read_off(head + rest)), "this is not an OFF file in text form") << head;
    }
}

TEST(ModelFile, StlFilesWithMoreThanTheirTriangles) {
    const auto binary = [](std::string head, std::uint32_t count, std::size_t triangles) {
        head.resize(80, ' ');
        head += bytes_of(count);
        for (std::size_t k = 0; k < triangles; ++k) {
            const float z = static_cast<float>(k);
            for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, z, 1.F, 0.F, z, 0.F, 1.F, z})
                head += bytes_of(number);
            head += std::string(2, '\0');
        }
        return head;
    };
    for (const char* head : {"", "solid of bytes", " Solid"}) {
        for (const std::size_t more : {0, 1, 12, 120}) {
            const auto soup = read_stl(binary(head, 2, 2) + std::string(more, 'x'));
            ASSERT_TRUE(soup) << head << more << fault_of(soup);
            EXPECT_EQ(soup->polygon_count(), 2u);
        }
        // A count that is too small, or that has not been written yet.
        for (const std::uint32_t count : {0u, 1u}) {
            const auto soup = read_stl(binary(head, count, 3));
            ASSERT_FALSE(soup);
            EXPECT_THAT(soup.error().message, HasSubstr("the STL file is 234 bytes long, but its"));
            EXPECT_THAT(soup.error().hint, HasSubstr("is too small"));
        }
        EXPECT_EQ(read_stl(binary(head, 4, 3)).error().hint, "it may be truncated");
    }
}

TEST(ModelFile, LinesEndInEveryWay) {
    for (const char* end : {"\n", "\r\n", "\r", "\r\r\n"}) {
        const auto with_ends = [&](std::string text) {
            std::string all;
            for (const char c : text) all += c == '\n' ? std::string(end) : std::string(1, c);
            return all;
        };
        const auto obj = read_obj(with_ends("# all\nv 0 0 0\nv 1 0 0\nv 0 \\\n1 0\nf 1 2 3\n"));
        ASSERT_TRUE(obj) << fault_of(obj);
        EXPECT_EQ(obj->points.size(), 3u);
        EXPECT_EQ(obj->polygon_count(), 1u);
        const auto off = read_off(with_ends("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2"));
        EXPECT_EQ(fault_of(off), "read");
        EXPECT_EQ(fault_of(read_stl(
                      with_ends("solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                "endloop\nendsolid\n"))),
                  "read");
    }
    EXPECT_EQ(fault_of(read_obj("v 0 0 0\r\nv 1 0 0\r\nv 0 x 0\r\n")),
              "line 3 of the OBJ file is not the position of a point");
    EXPECT_EQ(fault_of(read_obj("v 0 0 0\rv 1 0 0\rv 0 x 0\r")),
              "line 3 of the OBJ file is not the position of a point");
}

TEST(ModelFile, TextOfOtherUnits) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(fault_of(read_model_bytes("\xef\xbb\xbf" + text, "obj")), "read");
    for (const char* ending : {"obj", "off", "ply", "stl", "gltf"}) {
        std::string little, big;
        for (const char c : text + text + text) {
            little += {c, '\0'};
            big += {'\0', c};
        }
        for (const std::string& bytes : {little, big, "\xff\xfe" + little, "\xfe\xff" + big}) {
            EXPECT_THAT(fault_of(read_model_bytes(bytes, ending)), HasSubstr("UTF-16")) << ending;
        }
    }
}

TEST(ModelFile, AGltfFileIsPlacedByItsNodes) {
    for (const char* indices : {R"("indices":1,)", ""}) {
        const auto soup = read_gltf(gltf_text(indices));
        ASSERT_TRUE(soup) << fault_of(soup);
        ASSERT_EQ(soup->points.size(), 3u);
        EXPECT_EQ(soup->points[0], (Vector3d{2, 0, 0}));
        EXPECT_EQ(soup->points[1], (Vector3d{4, 0, 0}));
        EXPECT_EQ(soup->points[2], (Vector3d{2, 2, 0}));
        EXPECT_THAT(soup->polygon(0), ElementsAre(0, 1, 2));
    }
}

TEST(ModelFile, BrokenGltfFiles) {
    const auto fault_with = [](std::string_view from, std::string_view to) {
        std::string text = gltf_text();
        text.replace(text.find(from), from.size(), to);
        return fault_of(read_gltf(text));
    };
    EXPECT_EQ(fault_with(R"({"asset")", "nonsense"), "this is not a glTF file that can be read");
    EXPECT_EQ(fault_with(R"("children":[1])", R"("children":[0])"),
              "the nodes of the glTF file do not form a tree");
    EXPECT_EQ(fault_with(R"("children":[1])", R"("children":[7])"), "the glTF file has no node 7");
    EXPECT_EQ(fault_with(R"("mesh":0)", R"("mesh":3)"), "the glTF file has no mesh 3");
    EXPECT_EQ(fault_with(R"("count":3,"type":"VEC3")", R"("count":300000,"type":"VEC3")"),
              "the glTF file has triangles without positions or beyond its data");
    EXPECT_EQ(fault_with(R"("byteOffset":36)", R"("byteOffset":40)"),
              "the triangles of the glTF file lie beyond its data");
}

TEST(ModelFile, NamesDecideTheFormat) {
    EXPECT_THAT(fault_of(read_model("cow.blend")), HasSubstr("'cow.blend' is not a model"));
    EXPECT_THAT(fault_of(read_model("/nowhere/cow.PLY")), HasSubstr("cow.PLY"));
    const auto path = std::filesystem::path(testing::TempDir()) / "points.ply";
    std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                           "property float y\nproperty float z\nend_header\n1 2 3\n";
    EXPECT_THAT(fault_of(read_model(path)), HasSubstr("has 1 points but no faces"));
}

}  // namespace
}  // namespace cascade
