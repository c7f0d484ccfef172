/* SPDX-License-Identifier: 0BSD */
/*
 * vmtool: what the tests in the guest need beside the program on trial: other programs that hold a
 * device, the other end of a video loop, and plain writers that prove the kernel's side by
 * themselves. Each command returns the exit status.
 */
#ifndef VMTOOL_H
#define VMTOOL_H

/* Says what failed, with errno's sentence; returns 1. */
int failed(const char *what);

/* pins.c */
int tool_hold(int argc, char **argv); /* CHIP LINE: requests the line and keeps it */
int tool_spi(int argc, char **argv);  /* SPIDEV CHIP DC RESET WIDTH HEIGHT: a pattern */

/* keys.c */
int tool_keys(int argc, char **argv); /* FIFO: makes an input device; takes `TYPE CODE VALUE` */

/* screen.c */
int tool_console(int argc, char **argv); /* prints the console's mode: text or graphics */
int tool_fb(int argc, char **argv);      /* FBDEV: the same pattern */
int tool_master(int argc, char **argv);  /* CARD [PID]: is DRM master, if need be instead of PID */
int tool_size(int argc, char **argv);    /* FBDEV: prints width, height, bits, line length */

/* video.c */
int tool_loop(int argc, char **argv);    /* OUT CAP WIDTH HEIGHT FOURCC: joins vivid's ends */
int tool_capture(int argc, char **argv); /* DEVICE FRAMES FILE */
int tool_feed(int argc, char **argv);    /* DEVICE FILE: sends the file as a frame, for ever */

/* The pattern at a pixel, 16 bits as RGB565. */
static inline unsigned pattern(unsigned x, unsigned y, unsigned width, unsigned height)
{
    return (x * 31 / width) << 11 | (y * 63 / height) << 5 | ((x ^ y) & 31);
}

#endif
