/* Grows Turing's spots with a step that Cascade compiled, in a program that needs no Cascade.
 *
 *     ./cascade compile examples/c_program/spots.cascade -o step.o --header step.h
 *     cc -O2 -I. examples/c_program/main.c step.o -lpng -o spots && ./spots spots.png
 */
#include "step.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>

enum { width = 128, height = 128, steps = 10000 };

static float *make_plane(float value) {
    const size_t size = spots_stage1_plane_size(width, height);
    float *data = aligned_alloc(64, (size * sizeof(float) + 63) / 64 * 64);
    if (!data) exit(1);
    for (size_t k = 0; k < size; ++k) data[k] = value;
    return data + spots_stage1_origin(width);
}

static void swap(float **one, float **other) {
    float *const kept = *one;
    *one = *other;
    *other = kept;
}

/* Dark where b is low, as in Turk's figures. */
static int write_picture(const char *name, const float *b) {
    static unsigned char pixels[width * height];
    float low = b[0], high = b[0];
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const float value = b[j * spots_stage1_stride(width) + i];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    }
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const float value = b[j * spots_stage1_stride(width) + i];
            pixels[j * width + i] = (unsigned char)(255 * (value - low) / (high - low));
        }
    }
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height,
                       .format = PNG_FORMAT_GRAY};
    return png_image_write_to_file(&image, name, 0, pixels, 0, NULL) ? 0 : 1;
}

int main(int argc, char **argv) {
    float *a = make_plane(4), *b = make_plane(4), *new_a = make_plane(4), *new_b = make_plane(4);
    float *const beta = make_plane(12);
    srand(1);
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            beta[j * spots_stage1_stride(width) + i] += 0.2f * (float)rand() / (float)RAND_MAX - 0.1f;
        }
    }
    float numbers[SPOTS_STAGE1_UNIFORMS];
    numbers[SPOTS_STAGE1_UNIFORM_KA] = 1.0f / 80;
    numbers[SPOTS_STAGE1_UNIFORM_DIFF_A] = 1.0f / 8;
    numbers[SPOTS_STAGE1_UNIFORM_DIFF_B] = 1.0f / 32;
    numbers[SPOTS_STAGE1_UNIFORM_SPEED] = 1;

    spots_stage1_environment();
    for (int step = 0; step < steps; ++step) {
        float *fields[SPOTS_STAGE1_FIELDS];
        float *results[SPOTS_STAGE1_RESULTS] = {new_a, new_b};
        fields[SPOTS_STAGE1_FIELD_A] = a;
        fields[SPOTS_STAGE1_FIELD_B] = b;
        fields[SPOTS_STAGE1_FIELD_BETA] = beta;
        spots_stage1_step(fields, NULL, numbers, results, width, height, 1);
        swap(&a, &new_a);
        swap(&b, &new_b);
    }
    return write_picture(argc > 1 ? argv[1] : "spots.png", b);
}
