/* SPDX-License-Identifier: 0BSD */
/* PPM files, the binary kind with 8 bits a channel (P6, 255). */
#include <string.h>

#include "image.h"

static bool ppm_write(FILE *stream, const struct image *image, struct image_error *error)
{
    (void)error;
    fprintf(stream, "P6\n%lu %lu\n255\n", (unsigned long)image->width,
            (unsigned long)image->height);
    fwrite(image->rgb, (size_t)3 * image->width, image->height, stream);
    return true;
}

static bool is_space(int c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static bool is_digit(int c)
{
    return c >= '0' && c <= '9';
}

/* The next byte that is not a comment's. */
static int next_byte(FILE *stream)
{
    int c = getc(stream);
    if (c == '#') {
        while (c != '\n' && c != EOF) {
            c = getc(stream);
        }
    }
    return c;
}

/* A decimal number and the one byte behind it; -1 where there is none up to max. */
static long read_number(FILE *stream, long max)
{
    long number = 0;
    int c = next_byte(stream);
    while (is_space(c)) {
        c = next_byte(stream);
    }
    if (!is_digit(c)) {
        return -1;
    }
    while (is_digit(c)) {
        number = 10 * number + (c - '0');
        if (number > max) {
            return -1;
        }
        c = next_byte(stream);
    }
    return is_space(c) ? number : -1;
}

static bool ppm_read(FILE *stream, struct image *image, struct image_error *error)
{
    *image = (struct image){ 0 };
    char magic[2];
    if (fread(magic, 1, 2, stream) != 2 || memcmp(magic, "P6", 2) != 0) {
        return image_fail(error, "this is not a binary PPM file (P6)");
    }
    long width = read_number(stream, IMAGE_SIZE_MAX);
    long height = read_number(stream, IMAGE_SIZE_MAX);
    long levels = read_number(stream, IMAGE_SIZE_MAX);
    if (width < 1 || height < 1 || levels != 255) {
        return image_fail(error, "the PPM's header is not `width height 255`");
    }
    if (!image_make(image, (uint32_t)width, (uint32_t)height, error)) {
        return false;
    }
    size_t rows = fread(image->rgb, (size_t)3 * image->width, image->height, stream);
    if (rows != image->height) {
        image_free(image);
        return image_fail(error, "the PPM file is cut off");
    }
    return true;
}

const struct image_format image_ppm = { "PPM", ".ppm", ppm_write, ppm_read };
