/* SPDX-License-Identifier: 0BSD */
/* The console, frame buffers and DRM, straight to the kernel. */
#include <fcntl.h>
#include <linux/fb.h>
#include <linux/kd.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tests/vm/tool/tool.h"

/* As in <drm/drm.h>, which a system without libdrm does not have. */
#define DRM_SET_MASTER _IO('d', 0x1e)
#define DRM_DROP_MASTER _IO('d', 0x1f)

int tool_console(int argc, char **argv)
{
    int mode = -1;
    int fd = open("/dev/tty0", O_RDWR);
    (void)argc;
    (void)argv;
    if (fd < 0 || ioctl(fd, KDGETMODE, &mode) != 0) {
        return failed("/dev/tty0");
    }
    puts(mode == KD_TEXT ? "text" : "graphics");
    return 0;
}

static int look(const char *path, struct fb_var_screeninfo *v, struct fb_fix_screeninfo *f)
{
    int fd = open(path, O_RDWR);
    if (fd < 0 || ioctl(fd, FBIOGET_VSCREENINFO, v) != 0 ||
        ioctl(fd, FBIOGET_FSCREENINFO, f) != 0) {
        return -1;
    }
    return fd;
}

int tool_size(int argc, char **argv)
{
    struct fb_var_screeninfo v;
    struct fb_fix_screeninfo f;
    (void)argc;
    if (look(argv[0], &v, &f) < 0) {
        return failed(argv[0]);
    }
    printf("%u %u %u %u %u %u\n", v.xres, v.yres, v.bits_per_pixel, f.line_length, v.yres_virtual,
           v.yoffset);
    return 0;
}

int tool_fb(int argc, char **argv)
{
    struct fb_var_screeninfo v;
    struct fb_fix_screeninfo f;
    int fd = look(argv[0], &v, &f);
    (void)argc;
    if (fd < 0) {
        return failed(argv[0]);
    }
    uint8_t *memory = mmap(NULL, f.smem_len, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (memory == MAP_FAILED) {
        return failed("mmap");
    }
    for (unsigned y = 0; y < v.yres; y++) {
        for (unsigned x = 0; x < v.xres; x++) {
            uint32_t p = pattern(x, y, v.xres, v.yres);
            uint32_t wide = (p >> 11) << 19 | (p >> 5 & 63) << 10 | (p & 31) << 3;
            uint8_t *at = memory + (size_t)y * f.line_length + x * (v.bits_per_pixel / 8);
            memcpy(at, v.bits_per_pixel == 32 ? &wide : &p, v.bits_per_pixel / 8);
        }
    }
    return 0;
}

/* A process' own open file of that name, as a file of ours; -1: it has none. */
static int file_of(int pid, const char *path)
{
    char name[64];
    char target[256];
    int process = (int)syscall(SYS_pidfd_open, pid, 0);
    for (int fd = 0; process >= 0 && fd < 64; fd++) {
        snprintf(name, sizeof name, "/proc/%d/fd/%d", pid, fd);
        ssize_t length = readlink(name, target, sizeof target - 1);
        if (length > 0 && (size_t)length == strlen(path) &&
            memcmp(target, path, (size_t)length) == 0) {
            return (int)syscall(SYS_pidfd_getfd, process, fd, 0);
        }
    }
    return -1;
}

int tool_master(int argc, char **argv)
{
    int fd = open(argv[0], O_RDWR);
    if (argc > 1) {
        int theirs = file_of(atoi(argv[1]), argv[0]);
        if (theirs < 0 || ioctl(theirs, DRM_DROP_MASTER, 0) != 0) {
            return failed("taking it from the other process");
        }
        close(theirs);
    }
    if (fd < 0 || ioctl(fd, DRM_SET_MASTER, 0) != 0) {
        return failed(argv[0]);
    }
    puts("master");
    fflush(stdout);
    for (;;) {
        pause();
    }
}
