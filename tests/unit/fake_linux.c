/* SPDX-License-Identifier: 0BSD */
/* The made-up kernel. */
#include "tests/unit/fake_linux.h"

#include <errno.h>
#include <linux/kd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

struct fake_linux fake;

static bool fails(const char *name)
{
    fake.calls++;
    if (fake.calls == fake.fail_at || (fake.fail_every != 0 && fake.calls % fake.fail_every == 0)) {
        fake.failed++;
        snprintf(fake.last_failed, sizeof fake.last_failed, "%s", name);
        errno = fake.fail_errno;
        return true;
    }
    return false;
}

static int refuse(int number)
{
    errno = number;
    return -1;
}

static void set_channel(struct fb_bitfield *field, uint32_t offset, uint32_t length)
{
    field->offset = offset;
    field->length = length;
}

void fake_set_mode(uint32_t width, uint32_t height, uint32_t bits, bool red_is_high,
                   uint32_t line_bytes, uint32_t pages)
{
    uint32_t length = bits == 16 ? 5 : 8;
    uint32_t high = bits == 16 ? 11 : 16;
    fake.mode = (struct fb_var_screeninfo){ .xres = width,
                                            .yres = height,
                                            .xres_virtual = width,
                                            .yres_virtual = pages * height,
                                            .bits_per_pixel = bits };
    set_channel(&fake.mode.red, red_is_high ? high : 0, length);
    set_channel(&fake.mode.green, bits == 16 ? 5 : 8, bits == 16 ? 6 : 8);
    set_channel(&fake.mode.blue, red_is_high ? 0 : high, length);
    fake.fix = (struct fb_fix_screeninfo){ .line_length = line_bytes,
                                           .smem_len = line_bytes * height * pages,
                                           .type = FB_TYPE_PACKED_PIXELS,
                                           .ypanstep = pages > 1 ? 1 : 0 };
    memcpy(fake.fix.id, "made up", 8);
}

void fake_reset(void)
{
    free(fake.memory);
    for (size_t i = 0; i < FAKE_BUFFERS; i++) {
        free(fake.buffers[i]);
    }
    fake = (struct fake_linux){
        .capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING,
        .format = { .width = 64, .height = 48, .pixelformat = V4L2_PIX_FMT_RGB565 },
        .offers = { V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_RGB565 },
        .console_mode = KD_TEXT,
        .now_us = 1000000,
        .fail_errno = EIO,
    };
    fake_set_mode(320, 240, 16, true, 672, 1);
    fake.memory = calloc(1, FAKE_MEMORY);
}

/* ---- files ---- */

static enum fake_kind kind_of(int fd)
{
    return fd >= FAKE_FIRST_FD && fd < FAKE_FIRST_FD + FAKE_FDS
               ? (enum fake_kind)fake.kinds[fd - FAKE_FIRST_FD]
               : FAKE_NONE;
}

static int fake_open(const char *path, int flags)
{
    static const struct {
        const char *path;
        enum fake_kind kind;
    } nodes[] = { { "/dev/fb0", FAKE_FB },
                  { "/dev/video0", FAKE_CAMERA },
                  { "/dev/video1", FAKE_OUT },
                  { "/dev/tty0", FAKE_CONSOLE },
                  { "/dev/null", FAKE_PLAIN } };
    (void)flags;
    if (fails("open")) {
        return -1;
    }
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++) {
        for (int k = 0; strcmp(path, nodes[i].path) == 0 && k < FAKE_FDS; k++) {
            if (fake.kinds[k] == FAKE_NONE) {
                fake.kinds[k] = (int)nodes[i].kind;
                fake.open_fds++;
                return FAKE_FIRST_FD + k;
            }
        }
    }
    return refuse(ENOENT);
}

static int fake_close(int fd)
{
    if (kind_of(fd) == FAKE_NONE) {
        return refuse(EBADF);
    }
    fake.kinds[fd - FAKE_FIRST_FD] = FAKE_NONE;
    fake.open_fds--;
    return 0;
}

static void *fake_mmap(size_t bytes, int fd, uint64_t offset)
{
    if (fails("mmap")) {
        return MAP_FAILED;
    }
    fake.mapped++;
    if (kind_of(fd) == FAKE_FB) {
        return bytes <= FAKE_MEMORY ? fake.memory : MAP_FAILED;
    }
    return fake.buffers[offset / 0x1000];
}

static int fake_munmap(void *memory, size_t bytes)
{
    (void)memory;
    (void)bytes;
    fake.mapped--;
    return 0;
}

static ssize_t fake_read(int fd, void *bytes, size_t count)
{
    (void)fd;
    (void)bytes;
    (void)count;
    return 0;
}

static ssize_t fake_write(int fd, const void *bytes, size_t count)
{
    if (fails("write")) {
        return -1;
    }
    if (kind_of(fd) == FAKE_CONSOLE && count == 6) {
        fake.cursor_is_hidden = memcmp(bytes, "\033[?25l", 6) == 0;
    }
    return (ssize_t)count;
}

/* ---- the frame buffer ---- */

static int put_mode(const struct fb_var_screeninfo *wanted)
{
    if (wanted->bits_per_pixel != fake.mode.bits_per_pixel && !fake.fb_keeps_depth) {
        uint32_t pages = fake.mode.yres_virtual / fake.mode.yres;
        fake_set_mode(fake.mode.xres, fake.mode.yres, wanted->bits_per_pixel, true,
                      fake.mode.xres * wanted->bits_per_pixel / 8, pages);
    }
    return 0;
}

static int pan(const struct fb_var_screeninfo *wanted)
{
    if (fake.fix.ypanstep == 0 || wanted->yoffset + fake.mode.yres > fake.mode.yres_virtual) {
        return refuse(EINVAL);
    }
    fake.pans++;
    fake.mode.yoffset = fake.fb_pan_lies ? 0 : wanted->yoffset;
    return 0;
}

static int fb_control(unsigned long request, void *argument)
{
    switch (request) {
    case FBIOGET_VSCREENINFO:
        memcpy(argument, &fake.mode, sizeof fake.mode);
        return 0;
    case FBIOGET_FSCREENINFO:
        memcpy(argument, &fake.fix, sizeof fake.fix);
        return 0;
    case FBIOPUT_VSCREENINFO:
        return put_mode(argument);
    case FBIOPAN_DISPLAY:
        return pan(argument);
    case FBIO_WAITFORVSYNC:
        fake.vsyncs++;
        fake.now_us += 16667;
        return fake.fb_has_vsync ? 0 : refuse(ENOTTY);
    default:
        return refuse(ENOTTY);
    }
}

/* ---- video ---- */

static uint32_t line_bytes(uint32_t pixels, uint32_t width)
{
    return (pixels == V4L2_PIX_FMT_NV12     ? width
            : pixels == V4L2_PIX_FMT_XBGR32 ? 4 * width
                                            : 2 * width) +
           32; /* never without padding */
}

static int set_format(struct v4l2_format *format)
{
    struct v4l2_pix_format *pixels = &format->fmt.pix;
    if (fake.video_own_size) {
        pixels->width = fake.format.width;
        pixels->height = fake.format.height;
    }
    if (pixels->pixelformat != V4L2_PIX_FMT_RGB565 && pixels->pixelformat != V4L2_PIX_FMT_XBGR32 &&
        pixels->pixelformat != V4L2_PIX_FMT_YUYV && pixels->pixelformat != V4L2_PIX_FMT_NV12) {
        pixels->pixelformat = V4L2_PIX_FMT_GREY;
    }
    pixels->bytesperline = line_bytes(pixels->pixelformat, pixels->width);
    pixels->sizeimage = pixels->bytesperline * pixels->height * 3 / 2;
    fake.format = *pixels;
    return 0;
}

static int request_buffers(struct v4l2_requestbuffers *request)
{
    request->count = request->count > FAKE_BUFFERS ? FAKE_BUFFERS : request->count;
    fake.buffer_count = request->count;
    for (uint32_t i = 0; i < request->count; i++) {
        free(fake.buffers[i]);
        fake.buffers[i] = calloc(1, fake.format.sizeimage);
    }
    return 0;
}

static int queue_buffer(const struct v4l2_buffer *buffer)
{
    for (uint32_t i = 0; i < fake.queued; i++) {
        if (fake.queue[i] == buffer->index) {
            return refuse(EINVAL);
        }
    }
    if (buffer->index >= fake.buffer_count) {
        return refuse(EINVAL);
    }
    fake.queue[fake.queued++] = buffer->index;
    return 0;
}

/* An output keeps its last buffer on the screen; a camera has taken so many pictures. */
static int dequeue_buffer(struct v4l2_buffer *buffer)
{
    bool output = buffer->type == V4L2_BUF_TYPE_VIDEO_OUTPUT;
    bool ready = output ? fake.queued > 1 : fake.taken > 0 && fake.queued > 0;
    if (!fake.streaming || fake.video_is_stuck || !ready) {
        return refuse(EAGAIN);
    }
    buffer->index = fake.queue[0];
    fake.queued--;
    memmove(fake.queue, fake.queue + 1, fake.queued * sizeof fake.queue[0]);
    buffer->timestamp.tv_sec = (time_t)(fake.now_us / 1000000);
    buffer->timestamp.tv_usec = (suseconds_t)(fake.now_us % 1000000);
    fake.frames++;
    if (!output) {
        fake.taken--;
        memset(fake.buffers[buffer->index], (int)++fake.sequence, fake.format.sizeimage);
    }
    return 0;
}

static int describe(struct v4l2_buffer *buffer)
{
    buffer->length = fake.format.sizeimage;
    buffer->m.offset = buffer->index * 0x1000;
    return 0;
}

static int offer(struct v4l2_fmtdesc *description)
{
    if (description->index >= 4 || fake.offers[description->index] == 0) {
        return refuse(EINVAL);
    }
    description->pixelformat = fake.offers[description->index];
    return 0;
}

static int video_control(unsigned long request, void *argument)
{
    switch (request) {
    case VIDIOC_QUERYCAP:
        ((struct v4l2_capability *)argument)->capabilities = fake.capabilities;
        return 0;
    case VIDIOC_G_FMT:
        ((struct v4l2_format *)argument)->fmt.pix = fake.format;
        return 0;
    case VIDIOC_S_FMT:
        return set_format(argument);
    case VIDIOC_ENUM_FMT:
        return offer(argument);
    case VIDIOC_REQBUFS:
        return request_buffers(argument);
    case VIDIOC_QUERYBUF:
        return describe(argument);
    case VIDIOC_QBUF:
        return queue_buffer(argument);
    case VIDIOC_DQBUF:
        return dequeue_buffer(argument);
    case VIDIOC_STREAMON:
        fake.streaming = true;
        return 0;
    case VIDIOC_STREAMOFF:
        fake.streaming = false;
        fake.queued = 0;
        return 0;
    default:
        return refuse(ENOTTY);
    }
}

/* ---- all ---- */

static int fake_ioctl(int fd, unsigned long request, void *argument)
{
    if (fails("ioctl")) {
        return -1;
    }
    switch (kind_of(fd)) {
    case FAKE_FB:
        return fb_control(request, argument);
    case FAKE_OUT:
    case FAKE_CAMERA:
        return video_control(request, argument);
    case FAKE_CONSOLE:
        if (request == KDGETMODE) {
            *(int *)argument = fake.console_mode;
            return 0;
        }
        if (request == KDSETMODE) {
            fake.console_mode = (int)(intptr_t)argument;
            return 0;
        }
        return refuse(ENOTTY);
    case FAKE_NONE:
        return refuse(EBADF);
    default:
        return refuse(ENOTTY);
    }
}

static int fake_poll(struct pollfd *fds, size_t count, const struct timespec *timeout)
{
    (void)fds;
    (void)count;
    if (timeout != NULL) {
        fake.now_us += (uint64_t)timeout->tv_sec * 1000000 + (uint64_t)timeout->tv_nsec / 1000;
    }
    return 0;
}

static int fake_now(struct timespec *now)
{
    *now = (struct timespec){ .tv_sec = (time_t)(fake.now_us / 1000000),
                              .tv_nsec = (long)(fake.now_us % 1000000) * 1000 };
    return 0;
}

static int fake_sleep(const struct timespec *until)
{
    uint64_t until_us = (uint64_t)until->tv_sec * 1000000 + (uint64_t)until->tv_nsec / 1000;
    fake.now_us = until_us > fake.now_us ? until_us : fake.now_us;
    return 0;
}

const struct linux_system fake_linux = {
    .open = fake_open,
    .close = fake_close,
    .ioctl = fake_ioctl,
    .mmap = fake_mmap,
    .munmap = fake_munmap,
    .read = fake_read,
    .write = fake_write,
    .poll = fake_poll,
    .now = fake_now,
    .sleep = fake_sleep,
};
