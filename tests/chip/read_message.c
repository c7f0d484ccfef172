/* SPDX-License-Identifier: 0BSD */
/* read_message <picture.ppm: prints the text of a message that a device shows at scale 1. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/device/font.h"

enum { CELL = 6, ROW = 8, BYTES_MAX = 1 << 24 };

static const char letters[] = " ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,;:'-()/?";

static bool is_letter(const unsigned char *p, size_t stride, char letter)
{
    for (unsigned line = 0; line < ROW; line++) {
        unsigned bits = 0;
        for (unsigned x = 0; x < CELL; x++) {
            bits |= (p[line * stride + 3 * x] > 127 ? 1u : 0u) << x;
        }
        if (bits != font_line(letter, line)) {
            return false;
        }
    }
    return true;
}

static char read_letter(const unsigned char *p, size_t stride)
{
    for (const char *letter = letters; *letter != '\0'; letter++) {
        if (is_letter(p, stride, *letter)) {
            return *letter;
        }
    }
    return '#';
}

int main(void)
{
    static unsigned char picture[BYTES_MAX];
    unsigned width;
    unsigned height;
    int head = 0;
    size_t bytes = fread(picture, 1, sizeof picture - 1, stdin);
    if (sscanf((const char *)picture, "P6 %u %u 255%n", &width, &height, &head) != 2 || head == 0 ||
        bytes < (size_t)head + 1 + (size_t)3 * width * height) {
        fprintf(stderr, "read_message: this is no PPM\n");
        return 1;
    }
    size_t stride = (size_t)3 * width;
    for (unsigned y = 0; y + ROW <= height; y += ROW) {
        char row[1024] = "";
        size_t length = 0;
        for (unsigned x = 0; x + CELL <= width && length < sizeof row - 1; x += CELL) {
            row[length++] = read_letter(picture + head + 1 + y * stride + 3 * x, stride);
        }
        while (length > 0 && row[length - 1] == ' ') {
            length--;
        }
        row[length] = '\0';
        if (length > 0) {
            puts(row);
        }
    }
    return 0;
}
