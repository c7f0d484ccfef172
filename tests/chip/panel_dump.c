/* SPDX-License-Identifier: 0BSD */
/*
 * panel_dump FACTOR [rgb565] <dump.ppm >picture.ppm: an emulator's picture of
 * its window back to the panel's pixels, each of which must be a block of FACTOR
 * times FACTOR equal ones. Rows padded to 4 bytes, as some emulators write them,
 * are taken as well. rgb565: the pixels had 16 bits, which the emulator widened
 * in its way; they are widened in ours.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BYTES_MAX = 1 << 26 };

static int fail(const char *why)
{
    fprintf(stderr, "panel_dump: %s\n", why);
    return 1;
}

static unsigned char *read_all(size_t *bytes)
{
    unsigned char *memory = malloc(BYTES_MAX);
    *bytes = memory != NULL ? fread(memory, 1, BYTES_MAX, stdin) : 0;
    return memory;
}

/* Whether the block of factor times factor pixels at p is of one colour. */
static int is_block(const unsigned char *p, size_t stride, size_t factor)
{
    for (size_t y = 0; y < factor; y++) {
        for (size_t x = 0; x < factor; x++) {
            if (memcmp(p, p + y * stride + 3 * x, 3) != 0) {
                return 0;
            }
        }
    }
    return 1;
}

static void put_pixel(const unsigned char *p, int is_rgb565)
{
    unsigned char out[3] = { p[0], p[1], p[2] };
    if (is_rgb565) {
        out[0] = (unsigned char)(((p[0] >> 3) * 527 + 23) >> 6);
        out[1] = (unsigned char)(((p[1] >> 2) * 259 + 33) >> 6);
        out[2] = (unsigned char)(((p[2] >> 3) * 527 + 23) >> 6);
    }
    fwrite(out, 3, 1, stdout);
}

int main(int argc, char **argv)
{
    size_t factor = argc >= 2 ? strtoul(argv[1], NULL, 10) : 0;
    size_t bytes;
    unsigned width;
    unsigned height;
    int head = 0;
    unsigned char *dump = read_all(&bytes);
    if (factor == 0 || dump == NULL || bytes < 16) {
        return fail("usage: panel_dump FACTOR [rgb565] <dump.ppm >picture.ppm");
    }
    dump[bytes - 1 < BYTES_MAX - 1 ? bytes : bytes - 1] = '\0';
    if (sscanf((const char *)dump, "P6 %u %u 255%n", &width, &height, &head) != 2 || head == 0 ||
        height == 0 || width % factor != 0 || height % factor != 0) {
        return fail("this is no PPM of a multiple of the factor's size");
    }
    const unsigned char *pixels = dump + head + 1;
    size_t stride = (bytes - (size_t)head - 1) / height;
    if (stride != (size_t)3 * width && stride != ((size_t)3 * width + 3) / 4 * 4) {
        return fail("the PPM has not the bytes that its size promises");
    }
    printf("P6\n%zu %zu\n255\n", width / factor, height / factor);
    for (size_t y = 0; y < height; y += factor) {
        for (size_t x = 0; x < width; x += factor) {
            const unsigned char *p = pixels + y * stride + 3 * x;
            if (!is_block(p, stride, factor)) {
                return fail("a panel's pixel is not of one colour");
            }
            put_pixel(p, argc == 3 && strcmp(argv[2], "rgb565") == 0);
        }
    }
    free(dump);
    return fclose(stdout) == 0 ? 0 : fail("cannot write");
}
