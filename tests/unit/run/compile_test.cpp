// `cascade compile`: a C program that links the object file gets the bits of `cascade run`.

#include "run_fixture.h"

#include "run/compile.h"

#include <cstdlib>

#if CASCADE_HAS_JIT

namespace cascade {
namespace {

/// Steps the stage 'small' of two_stages from saved planes, with the header's own helpers.
constexpr const char* c_program = R"(
#include "step.h"
#include <stdio.h>
#include <stdlib.h>

enum { width = 24, height = 18 };

static float *plane(const char *name) {
    size_t size = test_small_plane_size(width, height) * sizeof(float);
    float *data = aligned_alloc(64, (size + 63) / 64 * 64);
    memset(data, 0, size);
    float *cells = data + test_small_origin(width);
    FILE *file = name ? fopen(name, "rb") : NULL;
    if (file) {
        /* The data of an .npy file are its last width * height numbers. */
        fseek(file, -(long)(width * height * sizeof(float)), SEEK_END);
        for (int j = 0; j < height; ++j)
            if (fread(cells + j * test_small_stride(width), sizeof(float), width, file) != width)
                exit(1);
        fclose(file);
    }
    return cells;
}

int main(int argc, char **argv) {
    int steps = atoi(argv[1]);
    float *a = plane("start/small.a.npy"), *b = plane("start/small.b.npy");
    float *new_a = plane(NULL), *new_b = plane(NULL);
    float *beta = plane("start/small.beta.npy"), *frozen = plane("start/small.frozen.npy");
    size_t cells = test_small_plane_size(width, height);
    unsigned char *mask_data = aligned_alloc(64, (cells + 63) / 64 * 64);
    unsigned char *mask = mask_data + test_small_origin(width);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            mask[j * test_small_stride(width) + i] =
                frozen[j * test_small_stride(width) + i] != 0;
    float numbers[TEST_SMALL_UNIFORMS];
    numbers[TEST_SMALL_UNIFORM_KA] = 0.2f / 16;
    numbers[TEST_SMALL_UNIFORM_DIFF_A] = 1.0f / 8;
    numbers[TEST_SMALL_UNIFORM_DIFF_B] = 1.0f / 32;
    numbers[TEST_SMALL_UNIFORM_SPEED] = 1;
    const unsigned char *masks[TEST_SMALL_MASKS] = {mask};
    test_small_environment();
    for (int step = 0; step < steps; ++step) {
        float *fields[TEST_SMALL_FIELDS], *results[TEST_SMALL_RESULTS] = {new_a, new_b};
        fields[TEST_SMALL_FIELD_A] = a;
        fields[TEST_SMALL_FIELD_B] = b;
        fields[TEST_SMALL_FIELD_BETA] = beta;
        test_small_step(fields, masks, numbers, results, width, height, 1);
        float *old_a = a, *old_b = b;
        a = new_a; b = new_b; new_a = old_a; new_b = old_b;
    }
    for (int j = 0; j < height; ++j)
        fwrite(b + j * test_small_stride(width), sizeof(float), width, stdout);
    return argc == 2 ? 0 : 1;
}
)";

class CompileTest : public RunTest {
protected:
    void save_stopped_at(std::int64_t step, const std::string& name) {
        Script script = load(two_stages);
        RunRequest wanted = request();
        wanted.save = path(name);
        wanted.stop_at = StopAt{"small", step};
        run_well(script, wanted);
    }

    void build(const std::string& target) {
        Script script = load(two_stages);
        CompileRequest wanted;
        wanted.stage = "small";
        wanted.target = target;
        const auto step = compile_step(script, wanted);
        ASSERT_TRUE(step) << step.error().message;
        ASSERT_TRUE(write_file(path("step.o"), {reinterpret_cast<const char*>(step->object.data()),
                                                step->object.size()}));
        ASSERT_TRUE(write_file(path("step.h"), step->header));
        ASSERT_TRUE(write_file(path("main.c"), c_program));
        ASSERT_EQ(command("cc -std=c11 -Wall -Wextra -Werror -O1 main.c step.o -o program"), 0);
    }

    int command(const std::string& text) {
        return std::system(("cd '" + folder_.string() + "' && " + text).c_str());
    }
};

TEST_F(CompileTest, ACProgramGetsTheBitsOfARun) {
    save_stopped_at(0, "start");
    save_stopped_at(77, "end");
    const auto expected = array("end/small.b.npy");
    for (const std::string target : {"", "x86-64", "x86-64-v3"}) {
        build(target);
        ASSERT_EQ(command("./program 77 > out.raw"), 0);
        const std::string raw = bytes("out.raw");
        ASSERT_EQ(raw.size(), expected.size() * sizeof(float));
        EXPECT_EQ(std::memcmp(raw.data(), expected.data(), raw.size()), 0) << target;
    }
}

TEST_F(CompileTest, AParameterCanBecomeAPlane) {
    Script script = load(two_stages);
    CompileRequest wanted;
    wanted.stage = "small";
    wanted.per_cell = {"ka"};
    const auto step = compile_step(script, wanted);
    ASSERT_TRUE(step) << step.error().message;
    EXPECT_NE(step->header.find("#define TEST_SMALL_FIELD_KA "), std::string::npos);
    EXPECT_EQ(step->header.find("#define TEST_SMALL_UNIFORM_KA "), std::string::npos);
}

TEST_F(CompileTest, WrongRequestsAreRefusedInWords) {
    Script script = load(two_stages);
    CompileRequest wanted;
    wanted.stage = "smal";
    EXPECT_EQ(compile_step(script, wanted).error().message, "no stage is called 'smal'");
    wanted.stage = "2";
    wanted.per_cell = {"kaa"};
    EXPECT_EQ(compile_step(script, wanted).error().hint, "did you mean 'ka'?");
    wanted.per_cell = {};
    wanted.target = "pentium-of-sorts";
    EXPECT_FALSE(compile_step(script, wanted));
}

}  // namespace
}  // namespace cascade

#endif
