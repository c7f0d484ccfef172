/* SPDX-License-Identifier: 0BSD */
/* Pins and SPI, straight to the kernel: no library that is on trial. */
#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/spi/spidev.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "tests/vm/tool/tool.h"

enum { CHUNK = 4096 }; /* spidev's buffer */

/* The line as an output; its file descriptor, or -1. */
static int request(const char *chip, const char *line, unsigned level)
{
    struct gpio_v2_line_request r = { .num_lines = 1 };
    int fd = open(chip, O_RDWR | O_CLOEXEC);
    r.offsets[0] = (uint32_t)atoi(line);
    strcpy(r.consumer, "vmtool");
    r.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
    r.config.num_attrs = 1;
    r.config.attrs[0].mask = 1;
    r.config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
    r.config.attrs[0].attr.values = level;
    if (fd < 0 || ioctl(fd, GPIO_V2_GET_LINE_IOCTL, &r) != 0) {
        return -1;
    }
    close(fd);
    return r.fd;
}

static int set(int line, unsigned level)
{
    struct gpio_v2_line_values v = { .bits = level, .mask = 1 };
    return ioctl(line, GPIO_V2_LINE_SET_VALUES_IOCTL, &v);
}

int tool_hold(int argc, char **argv)
{
    (void)argc;
    if (request(argv[0], argv[1], 0) < 0) {
        return failed(argv[1]);
    }
    puts("held");
    fflush(stdout);
    for (;;) {
        pause();
    }
}

static int transfer(int spi, int dc, unsigned level, const uint8_t *bytes, size_t count)
{
    if (set(dc, level) != 0) {
        return -1;
    }
    for (size_t at = 0; at < count; at += CHUNK) {
        struct spi_ioc_transfer t = { .tx_buf = (uintptr_t)(bytes + at), .bits_per_word = 8 };
        t.len = (uint32_t)(count - at < CHUNK ? count - at : CHUNK);
        if (ioctl(spi, SPI_IOC_MESSAGE(1), &t) < 0) {
            return -1;
        }
    }
    return 0;
}

int tool_spi(int argc, char **argv)
{
    unsigned width = (unsigned)atoi(argv[4]);
    unsigned height = (unsigned)atoi(argv[5]);
    int spi = open(argv[0], O_RDWR);
    int dc = request(argv[1], argv[2], 0);
    int reset = request(argv[1], argv[3], 0);
    uint8_t *pixels = malloc((size_t)width * height * 2);
    uint8_t mode = SPI_MODE_0;
    (void)argc;
    if (spi < 0 || dc < 0 || reset < 0 || pixels == NULL ||
        ioctl(spi, SPI_IOC_WR_MODE, &mode) < 0) {
        return failed("spi");
    }
    for (unsigned i = 0; i < width * height; i++) {
        unsigned p = pattern(i % width, i / width, width, height);
        pixels[2 * i] = (uint8_t)(p >> 8);
        pixels[2 * i + 1] = (uint8_t)p;
    }
    usleep(1000);
    set(reset, 1);
    usleep(120000);
    const struct {
        uint8_t code;
        uint8_t count;
        uint8_t parameters[4];
    } start[] = { { 0x11, 0, { 0 } },
                  { 0x3a, 1, { 0x55 } },
                  { 0x36, 1, { 0 } },
                  { 0x29, 0, { 0 } },
                  { 0x2a, 4, { 0, 0, (uint8_t)((width - 1) >> 8), (uint8_t)(width - 1) } },
                  { 0x2b, 4, { 0, 0, (uint8_t)((height - 1) >> 8), (uint8_t)(height - 1) } },
                  { 0x2c, 0, { 0 } } };
    int bad = 0;
    for (size_t i = 0; i < sizeof start / sizeof start[0]; i++) {
        bad |= transfer(spi, dc, 0, &start[i].code, 1);
        bad |= start[i].count > 0 ? transfer(spi, dc, 1, start[i].parameters, start[i].count) : 0;
        usleep(start[i].code == 0x11 ? 120000 : 0);
    }
    bad |= transfer(spi, dc, 1, pixels, (size_t)width * height * 2);
    free(pixels);
    return bad != 0 ? failed("transfer") : 0;
}
