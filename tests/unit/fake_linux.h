/* SPDX-License-Identifier: 0BSD */
/*
 * A kernel that is made up: a table of system calls with a frame buffer, a
 * video output, a camera and a console behind it, each call of which can fail.
 * There is one of it, as there is one kernel.
 */
#ifndef OLDWELL_TESTS_FAKE_LINUX_H
#define OLDWELL_TESTS_FAKE_LINUX_H

#include <linux/fb.h>
#include <linux/videodev2.h>
#include <stdbool.h>
#include <stdint.h>

#include "hal/linux/system.h"

enum fake_kind { FAKE_NONE, FAKE_FB, FAKE_OUT, FAKE_CAMERA, FAKE_CONSOLE, FAKE_PLAIN };

enum { FAKE_FDS = 16, FAKE_MEMORY = 1 << 20, FAKE_BUFFERS = 6, FAKE_FIRST_FD = 1000 };

struct fake_linux {
    /* What there is: /dev/fb0, /dev/video1 (output), /dev/video0 (camera), /dev/tty0. */
    struct fb_var_screeninfo mode;
    struct fb_fix_screeninfo fix;
    bool fb_keeps_depth; /* says yes to another depth and keeps its own */
    bool fb_pan_lies;    /* says yes and stays */
    bool fb_has_vsync;
    struct v4l2_pix_format format;
    uint32_t capabilities;
    uint32_t offers[4];  /* pixel formats, 0 ends */
    bool video_is_stuck; /* gives no buffer back */
    bool video_own_size; /* keeps its size, whatever is asked */
    int console_mode;    /* KD_TEXT or KD_GRAPHICS */
    bool cursor_is_hidden;
    uint64_t now_us; /* moves on when somebody waits */

    /* Faults: the call of this number (from 1) fails with this error; 0: none does. */
    uint32_t fail_at;
    int fail_errno;
    uint32_t fail_every; /* or every n-th */

    /* What happened. */
    uint32_t calls;
    uint32_t failed;
    char last_failed[32];
    uint32_t open_fds;
    uint32_t mapped;
    uint32_t pans;
    uint32_t vsyncs;
    uint32_t frames; /* buffers that the output has shown */
    bool streaming;
    uint8_t *memory; /* the frame buffer's */
    uint8_t *buffers[FAKE_BUFFERS];
    uint32_t queue[FAKE_BUFFERS]; /* numbers of buffers, in order */
    uint32_t queued;
    uint32_t buffer_count;
    uint32_t taken;    /* pictures that the camera has made and nobody took */
    uint32_t sequence; /* of the camera's frames: its first byte */
    int kinds[FAKE_FDS];
};

extern struct fake_linux fake;
extern const struct linux_system fake_linux;

/* 320x240, 16 bits in rows of 672 bytes, one page; video 64x48 RGB565; no faults. */
void fake_reset(void);

/* Another depth: 16 or 32 bits, red at the highest bits or at the lowest. */
void fake_set_mode(uint32_t width, uint32_t height, uint32_t bits, bool red_is_high,
                   uint32_t line_bytes, uint32_t pages);

#endif
