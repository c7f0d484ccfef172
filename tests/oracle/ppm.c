/* SPDX-License-Identifier: 0BSD */
/* Pictures in and out: binary PPM with 8 bits a channel. */
#include "tests/oracle/oracle.h"

#include <stdio.h>
#include <stdlib.h>

uint32_t *ppm_read(const char *path, uint32_t *width, uint32_t *height)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        stop(path, "no such frame");
    }
    if (fscanf(file, "P6 %u %u 255", width, height) != 2 || getc(file) == EOF) {
        stop(path, "not a binary PPM of 8 bits");
    }
    size_t count = (size_t)*width * *height;
    uint32_t *pixels = need(count, sizeof *pixels);
    for (size_t i = 0; i < count; i++) {
        uint8_t rgb[3];
        if (fread(rgb, 3, 1, file) != 1) {
            stop(path, "ends too early");
        }
        pixels[i] = (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
    }
    fclose(file);
    return pixels;
}

void ppm_write(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height)
{
    FILE *file = fopen(path, "wb");
    if (!file) {
        stop(path, "cannot be written");
    }
    fprintf(file, "P6\n%u %u\n255\n", width, height);
    size_t pixels = (size_t)width * height;
    if (fwrite(rgb, 3, pixels, file) != pixels || fclose(file) != 0) {
        stop(path, "cannot be written");
    }
}
