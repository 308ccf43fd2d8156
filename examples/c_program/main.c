/* Grows Turing's spots with a stage that Cascade has compiled. The program itself needs no Cascade.
 *
 *     ./cascade compile examples/c_program/spots.cascade --per-cell ka -o step.o
 *     cc -O2 -I. examples/c_program/main.c step.o -lpng -o spots && ./spots spots.png
 *
 * With -fopenmp it uses all cores.
 */
#include "step.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>

enum { width = SPOTS_STAGE1_WIDTH, height = SPOTS_STAGE1_HEIGHT };

/* Draws low values of b dark, as in Turk's figures. */
static int write_picture(const char *name, const float *b) {
    static unsigned char pixels[width * height];
    float low = b[0], high = b[0];
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const float value = b[spots_stage1_at(i, j, 0)];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    }
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const float value = b[spots_stage1_at(i, j, 0)];
            pixels[j * width + i] = (unsigned char)(255 * (value - low) / (high - low));
        }
    }
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height,
                       .format = PNG_FORMAT_GRAY};
    return png_image_write_to_file(&image, name, 0, pixels, 0, NULL) ? 0 : 1;
}

int main(int argc, char **argv) {
    void *const memory = malloc(SPOTS_STAGE1_BYTES);
    struct spots_stage1 spots;
    if (!memory) return 1;
    spots_stage1_init(&spots, memory);
    spots_stage1_start(&spots);

    /* The program must set the planes that the script left open. Here it sets a gradient of ka. */
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            spots.planes[SPOTS_STAGE1_PLANE_KA][spots_stage1_at(i, j, 0)] =
                (0.5f + (float)i / width) / 135;
        }
    }
    spots_stage1_run(&spots, SPOTS_STAGE1_ITERATIONS);

    const int status = write_picture(argc > 1 ? argv[1] : "spots.png",
                                     spots.species[SPOTS_STAGE1_SPECIES_B]);
    free(memory);
    return status;
}
