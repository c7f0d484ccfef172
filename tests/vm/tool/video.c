/* SPDX-License-Identifier: 0BSD */
/* Video devices: vivid's output joined to its capture, and the plain other end of a stream. */
#include <errno.h>
#include <fcntl.h>
#include <linux/v4l2-dv-timings.h>
#include <linux/videodev2.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/vm/tool/tool.h"

enum { BUFFERS = 4 };

/* Sets a control by its name; a menu by the beginning of an item's name. */
static bool set_control(int fd, const char *name, const char *item, int value)
{
    struct v4l2_query_ext_ctrl q = { .id = V4L2_CTRL_FLAG_NEXT_CTRL };
    while (ioctl(fd, VIDIOC_QUERY_EXT_CTRL, &q) == 0 && strcmp(q.name, name) != 0) {
        q.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    }
    if (strcmp(q.name, name) != 0) {
        return false;
    }
    for (int i = (int)q.minimum; item != NULL && i <= (int)q.maximum; i++) {
        struct v4l2_querymenu m = { .id = q.id, .index = (uint32_t)i };
        if (ioctl(fd, VIDIOC_QUERYMENU, &m) == 0 &&
            strncmp((const char *)m.name, item, strlen(item)) == 0) {
            value = i;
        }
    }
    struct v4l2_control c = { .id = q.id, .value = value };
    return ioctl(fd, VIDIOC_S_CTRL, &c) == 0;
}

/* Turns a device to its HDMI connector with the same timing on both ends. */
static int choose_hdmi(int fd, bool output)
{
    int number = -1;
    struct v4l2_output o = { .index = 0 };
    struct v4l2_input i = { .index = 0 };
    struct v4l2_dv_timings t = V4L2_DV_BT_DMT_640X480P60;
    if (output) {
        for (; number < 0 && ioctl(fd, VIDIOC_ENUMOUTPUT, &o) == 0; o.index++) {
            number = strstr((const char *)o.name, "HDMI") != NULL ? (int)o.index : -1;
        }
    } else {
        for (; number < 0 && ioctl(fd, VIDIOC_ENUMINPUT, &i) == 0; i.index++) {
            number = strstr((const char *)i.name, "HDMI") != NULL ? (int)i.index : -1;
        }
    }
    if (number < 0 || ioctl(fd, output ? VIDIOC_S_OUTPUT : VIDIOC_S_INPUT, &number) != 0) {
        return -1;
    }
    return ioctl(fd, VIDIOC_S_DV_TIMINGS, &t);
}

static void set_whole(int fd, uint32_t type, uint32_t target)
{
    struct v4l2_selection s = { .type = type, .target = target, .r = { 0, 0, 640, 480 } };
    ioctl(fd, VIDIOC_S_SELECTION, &s); /* not every format has it */
}

static int set_format(int fd, bool output, unsigned width, unsigned height, uint32_t fourcc)
{
    struct v4l2_format f = { .type = output ? V4L2_BUF_TYPE_VIDEO_OUTPUT
                                            : V4L2_BUF_TYPE_VIDEO_CAPTURE };
    f.fmt.pix.pixelformat = fourcc;
    f.fmt.pix.field = V4L2_FIELD_NONE;
    f.fmt.pix.width = 640; /* whole first: a smaller one leaves its cut behind */
    f.fmt.pix.height = 480;
    if (ioctl(fd, VIDIOC_S_FMT, &f) != 0) {
        return -1;
    }
    set_whole(fd, f.type, output ? V4L2_SEL_TGT_COMPOSE : V4L2_SEL_TGT_CROP);
    set_whole(fd, f.type, output ? V4L2_SEL_TGT_CROP : V4L2_SEL_TGT_COMPOSE);
    f.fmt.pix.width = width;
    f.fmt.pix.height = height;
    f.fmt.pix.bytesperline = 0;
    if (ioctl(fd, VIDIOC_S_FMT, &f) != 0 || f.fmt.pix.width != width ||
        f.fmt.pix.height != height) {
        return -1;
    }
    printf("%s stride %u size %u\n", output ? "output" : "capture", f.fmt.pix.bytesperline,
           f.fmt.pix.sizeimage);
    return 0;
}

int tool_loop(int argc, char **argv)
{
    int out = open(argv[0], O_RDWR);
    int in = open(argv[1], O_RDWR);
    unsigned width = (unsigned)atoi(argv[2]);
    unsigned height = (unsigned)atoi(argv[3]);
    char name[64];
    bool joined = false;
    (void)argc;
    if (out < 0 || in < 0 || strlen(argv[4]) != 4) {
        return failed("loop");
    }
    uint32_t fourcc = v4l2_fourcc(argv[4][0], argv[4][1], argv[4][2], argv[4][3]);
    if (choose_hdmi(out, true) != 0 || choose_hdmi(in, false) != 0) {
        return failed("HDMI");
    }
    for (int i = 0; i < 16 && !joined; i++) {
        snprintf(name, sizeof name, "HDMI 000-%d Is Connected To", i);
        joined = set_control(in, name, "Output ", 0);
    }
    if (!joined) {
        return failed("no control joins the two ends");
    }
    set_control(in, "OSD Text Mode", NULL, 2);
    if (set_format(out, true, width, height, fourcc) != 0 ||
        set_format(in, false, width, height, fourcc) != 0) {
        return failed("VIDIOC_S_FMT");
    }
    return 0;
}

struct stream {
    int fd;
    uint32_t type;
    unsigned count;
    struct {
        uint8_t *data;
        size_t length;
    } buffers[BUFFERS];
};

static int queue(const struct stream *s, unsigned index, uint32_t bytes)
{
    struct v4l2_buffer b = { .type = s->type, .memory = V4L2_MEMORY_MMAP, .index = index };
    b.bytesused = bytes;
    b.field = V4L2_FIELD_NONE;
    return ioctl(s->fd, VIDIOC_QBUF, &b);
}

static int prepare(struct stream *s, const char *path, uint32_t type)
{
    struct v4l2_requestbuffers r = { .count = BUFFERS, .type = type, .memory = V4L2_MEMORY_MMAP };
    s->fd = open(path, O_RDWR);
    s->type = type;
    if (s->fd < 0 || ioctl(s->fd, VIDIOC_REQBUFS, &r) != 0) {
        return -1;
    }
    s->count = r.count < BUFFERS ? r.count : BUFFERS;
    for (unsigned i = 0; i < s->count; i++) {
        struct v4l2_buffer b = { .type = type, .memory = V4L2_MEMORY_MMAP, .index = i };
        if (ioctl(s->fd, VIDIOC_QUERYBUF, &b) != 0) {
            return -1;
        }
        s->buffers[i].length = b.length;
        s->buffers[i].data =
            mmap(NULL, b.length, PROT_READ | PROT_WRITE, MAP_SHARED, s->fd, (off_t)b.m.offset);
        if (s->buffers[i].data == MAP_FAILED) {
            return -1;
        }
    }
    return 0;
}

int tool_capture(int argc, char **argv)
{
    struct stream s;
    int frames = atoi(argv[1]);
    FILE *file = fopen(argv[2], "wb");
    (void)argc;
    if (file == NULL || prepare(&s, argv[0], V4L2_BUF_TYPE_VIDEO_CAPTURE) != 0) {
        return failed(argv[0]);
    }
    int bad = 0;
    for (unsigned i = 0; i < s.count; i++) {
        bad |= queue(&s, i, 0);
    }
    bad |= ioctl(s.fd, VIDIOC_STREAMON, &s.type);
    while (bad == 0 && frames-- > 0) {
        struct v4l2_buffer b = { .type = s.type, .memory = V4L2_MEMORY_MMAP };
        bad = ioctl(s.fd, VIDIOC_DQBUF, &b);
        if (bad == 0) {
            fwrite(s.buffers[b.index].data, 1, b.bytesused, file);
            bad = queue(&s, b.index, 0);
        }
    }
    return bad != 0 || fclose(file) != 0 ? failed("capture") : 0;
}

int tool_feed(int argc, char **argv)
{
    struct stream s;
    FILE *file = fopen(argv[1], "rb");
    size_t size = 0;
    (void)argc;
    if (file == NULL || prepare(&s, argv[0], V4L2_BUF_TYPE_VIDEO_OUTPUT) != 0) {
        return failed(argv[0]);
    }
    int bad = 0;
    for (unsigned i = 0; i < s.count; i++) {
        rewind(file);
        size = fread(s.buffers[i].data, 1, s.buffers[i].length, file);
        bad |= queue(&s, i, (uint32_t)size);
    }
    bad |= ioctl(s.fd, VIDIOC_STREAMON, &s.type);
    puts("feeding");
    fflush(stdout);
    while (bad == 0) {
        struct v4l2_buffer b = { .type = s.type, .memory = V4L2_MEMORY_MMAP };
        bad = ioctl(s.fd, VIDIOC_DQBUF, &b);
        bad |= bad == 0 ? queue(&s, b.index, (uint32_t)size) : 0;
    }
    return failed("feed");
}
