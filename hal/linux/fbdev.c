/* SPDX-License-Identifier: 0BSD */
/* The frame buffer device. */
#include "hal/linux/fbdev.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "hal/linux/formats.h"
#include "hal/linux/mapping.h"

static int failed(struct linux_fbdev *fbdev, const char *call)
{
    return linux_fault_errno(&fbdev->fault, fbdev->config.device, call, errno);
}

static int control(struct linux_fbdev *fbdev, unsigned long request, void *argument)
{
    return linux_ioctl(fbdev->config.system, fbdev->fd, request, argument);
}

/* ---- the mode ---- */

static int read_mode(struct linux_fbdev *fbdev)
{
    return control(fbdev, FBIOGET_VSCREENINFO, &fbdev->mode) < 0
               ? failed(fbdev, "FBIOGET_VSCREENINFO")
               : OW_OK;
}

static bool channels(const struct fb_var_screeninfo *mode, uint32_t red, uint32_t green,
                     uint32_t blue, uint32_t bits)
{
    return mode->red.offset == red && mode->green.offset == green && mode->blue.offset == blue &&
           mode->red.length == bits && mode->blue.length == bits;
}

static const struct ow_pixel_format *format_of(const struct fb_var_screeninfo *mode)
{
    if (mode->bits_per_pixel == 16 && mode->green.length == 6) {
        return channels(mode, 11, 5, 0, 5)   ? &ow_format_rgb565
               : channels(mode, 0, 5, 11, 5) ? &linux_format_bgr565
                                             : NULL;
    }
    if (mode->bits_per_pixel == 32 && mode->green.length == 8) {
        return channels(mode, 16, 8, 0, 8)   ? &ow_format_xrgb8888
               : channels(mode, 0, 8, 16, 8) ? &linux_format_xbgr8888
                                             : NULL;
    }
    return NULL;
}

/* Some drivers say yes and change nothing: what counts is what is read back. */
static int set_depth(struct linux_fbdev *fbdev)
{
    uint32_t bits = fbdev->config.bits;
    if (bits == 0 || fbdev->mode.bits_per_pixel == bits) {
        return OW_OK;
    }
    struct fb_var_screeninfo wanted = fbdev->mode;
    wanted.bits_per_pixel = bits;
    wanted.activate = FB_ACTIVATE_NOW;
    bool refused = control(fbdev, FBIOPUT_VSCREENINFO, &wanted) < 0;
    int status = read_mode(fbdev);
    if (status == OW_OK && fbdev->mode.bits_per_pixel != bits) {
        status = linux_fault_note(
            &fbdev->fault, OW_UNSUPPORTED, fbdev->config.device, "FBIOPUT_VSCREENINFO",
            refused ? "the driver refuses this depth" : "the driver says yes and keeps its depth",
            "");
        linux_fault_remedy(&fbdev->fault, "leave out --depth, it has %u bits",
                           fbdev->mode.bits_per_pixel);
    }
    return status;
}

static int check_mode(struct linux_fbdev *fbdev, const struct fb_fix_screeninfo *fix)
{
    const struct fb_var_screeninfo *mode = &fbdev->mode;
    char why[128];
    const struct ow_pixel_format *format = format_of(mode);
    if (fix->type != FB_TYPE_PACKED_PIXELS || format == NULL) {
        snprintf(why, sizeof why, "%u bits a pixel, red %u at %u, green %u at %u, blue %u at %u",
                 mode->bits_per_pixel, mode->red.length, mode->red.offset, mode->green.length,
                 mode->green.offset, mode->blue.length, mode->blue.offset);
        return linux_fault_note(&fbdev->fault, OW_UNSUPPORTED, fbdev->config.device, NULL, why,
                                "give --depth 16 or 32; 565 and 8888 can be drawn");
    }
    uint64_t row = (uint64_t)(mode->xoffset + mode->xres) * mode->bits_per_pixel / 8;
    if (mode->xres < 1 || mode->xres > OW_PANEL_SIZE_MAX || mode->yres < 1 ||
        mode->yres > OW_PANEL_SIZE_MAX || fix->line_length < row || fix->line_length % 4 != 0 ||
        (uint64_t)fix->line_length * (mode->yoffset + mode->yres) > fix->smem_len) {
        snprintf(why, sizeof why, "%ux%u pixels, %u bytes a line, %u bytes of memory", mode->xres,
                 mode->yres, fix->line_length, fix->smem_len);
        return linux_fault_note(&fbdev->fault, OW_UNSUPPORTED, fbdev->config.device, NULL, why,
                                "this mode makes no sense here, set another one (fbset)");
    }
    fbdev->stride = fix->line_length;
    fbdev->info = (struct ow_panel_info){
        .width = (uint16_t)mode->xres,
        .height = (uint16_t)mode->yres,
        .format = format,
        .align_x = 1,
        .align_y = 1,
    };
    return OW_OK;
}

/* ---- pages ---- */

static uint8_t *page(const struct linux_fbdev *fbdev, uint32_t number)
{
    return fbdev->screen + (size_t)number * fbdev->info.height * fbdev->stride;
}

static int pan_to(struct linux_fbdev *fbdev, uint32_t number)
{
    struct fb_var_screeninfo wanted = fbdev->mode;
    wanted.yoffset = number * fbdev->info.height;
    wanted.activate = FB_ACTIVATE_VBL;
    return control(fbdev, FBIOPAN_DISPLAY, &wanted);
}

/* Two pages, if the driver has them, pans, and then says that it did. */
static bool try_two_pages(struct linux_fbdev *fbdev, struct fb_fix_screeninfo *fix)
{
    uint32_t height = fbdev->mode.yres;
    if (fix->ypanstep == 0 || height % fix->ypanstep != 0 || fbdev->mode.yoffset != 0 ||
        fbdev->mode.xoffset != 0) {
        return false;
    }
    if (fbdev->mode.yres_virtual < 2 * height) {
        struct fb_var_screeninfo wanted = fbdev->mode;
        wanted.yres_virtual = 2 * height;
        (void)control(fbdev, FBIOPUT_VSCREENINFO, &wanted);
        if (read_mode(fbdev) < 0 || control(fbdev, FBIOGET_FSCREENINFO, fix) < 0) {
            return false;
        }
    }
    return fbdev->mode.yres == height && fbdev->mode.yres_virtual >= 2 * height &&
           (uint64_t)fix->line_length * 2 * height <= fix->smem_len;
}

/* Both pages show the same while we try. */
static bool panning_works(struct linux_fbdev *fbdev)
{
    struct fb_var_screeninfo now;
    memcpy(page(fbdev, 1), page(fbdev, 0), (size_t)fbdev->info.height * fbdev->stride);
    if (pan_to(fbdev, 1) < 0) {
        return false;
    }
    bool moved =
        control(fbdev, FBIOGET_VSCREENINFO, &now) >= 0 && now.yoffset == fbdev->info.height;
    return pan_to(fbdev, 0) >= 0 && moved;
}

static int map_memory(struct linux_fbdev *fbdev, const struct fb_fix_screeninfo *fix)
{
    size_t within = (size_t)fix->smem_start % (size_t)sysconf(_SC_PAGESIZE);
    fbdev->mapped = within + fix->smem_len;
    fbdev->memory = linux_map(fbdev->config.system, fbdev->mapped, fbdev->fd, 0);
    if (fbdev->memory == NULL) {
        return failed(fbdev, "mmap");
    }
    fbdev->screen = fbdev->memory + within + (size_t)fbdev->mode.yoffset * fbdev->stride +
                    (size_t)fbdev->mode.xoffset * fbdev->mode.bits_per_pixel / 8;
    return OW_OK;
}

static int make_beside(struct linux_fbdev *fbdev)
{
    fbdev->beside_stride = (ow_row_bytes(fbdev->info.format, fbdev->info.width) + 3) / 4 * 4;
    fbdev->beside = calloc(fbdev->info.height, fbdev->beside_stride);
    if (fbdev->beside == NULL) {
        return linux_fault_note(&fbdev->fault, OW_MEMORY, fbdev->config.device, NULL,
                                "not enough memory for a frame", "");
    }
    return OW_OK;
}

static bool is_drm(const struct fb_fix_screeninfo *fix)
{
    char id[sizeof fix->id + 1] = { 0 };
    memcpy(id, fix->id, sizeof fix->id);
    return strstr(id, "drm") != NULL;
}

static int prepare(struct linux_fbdev *fbdev)
{
    struct fb_fix_screeninfo fix;
    int status = read_mode(fbdev);
    if (status < 0) {
        return status;
    }
    fbdev->before = fbdev->mode;
    status = set_depth(fbdev);
    if (status == OW_OK && control(fbdev, FBIOGET_FSCREENINFO, &fix) < 0) {
        status = failed(fbdev, "FBIOGET_FSCREENINFO");
    }
    if (status < 0) {
        return status;
    }
    bool two = !fbdev->config.one_page && try_two_pages(fbdev, &fix);
    status = check_mode(fbdev, &fix);
    if (status == OW_OK) {
        status = map_memory(fbdev, &fix);
    }
    if (status < 0) {
        return status;
    }
    /* DRM's emulation waits in the pan itself: a second wait would halve the rate. */
    uint32_t screen = 0;
    bool drm = is_drm(&fix);
    fbdev->pages = two && panning_works(fbdev) ? 2 : 1;
    fbdev->waits = !(drm && fbdev->pages == 2) && control(fbdev, FBIO_WAITFORVSYNC, &screen) >= 0;
    fbdev->info.buffers = (uint16_t)fbdev->pages;
    return fbdev->pages == 2 ? OW_OK : make_beside(fbdev);
}

int linux_fbdev_open(struct linux_fbdev *fbdev, const struct linux_fbdev_config *config)
{
    *fbdev = (struct linux_fbdev){ .config = *config, .fd = -1 };
    fbdev->fd = config->system->open(config->device, O_RDWR);
    if (fbdev->fd < 0) {
        return failed(fbdev, "open");
    }
    int status = prepare(fbdev);
    if (status < 0) {
        linux_fbdev_close(fbdev);
    }
    return status;
}

/* The console goes on drawing on the page where it was: the last picture moves there. */
static void go_back(struct linux_fbdev *fbdev)
{
    if (fbdev->shown == 1) {
        memcpy(page(fbdev, 0), page(fbdev, 1), (size_t)fbdev->info.height * fbdev->stride);
        (void)pan_to(fbdev, 0);
    }
    if (fbdev->mode.bits_per_pixel != fbdev->before.bits_per_pixel ||
        fbdev->mode.yres_virtual != fbdev->before.yres_virtual) {
        fbdev->before.activate = FB_ACTIVATE_NOW;
        (void)control(fbdev, FBIOPUT_VSCREENINFO, &fbdev->before);
    }
}

void linux_fbdev_close(struct linux_fbdev *fbdev)
{
    const struct linux_system *system = fbdev->config.system;
    if (fbdev->fd < 0 || system == NULL) {
        return;
    }
    if (fbdev->memory != NULL) {
        go_back(fbdev);
        linux_unmap(system, fbdev->memory, fbdev->mapped);
    }
    (void)system->close(fbdev->fd);
    free(fbdev->beside);
    fbdev->fd = -1;
    fbdev->memory = NULL;
    fbdev->beside = NULL;
}

/* ---- the panel ---- */

static int fbdev_info(void *device, struct ow_panel_info *info)
{
    const struct linux_fbdev *fbdev = device;
    *info = fbdev->info;
    return OW_OK;
}

static int wait_for_vsync(struct linux_fbdev *fbdev)
{
    uint32_t screen = 0;
    if (fbdev->waits && control(fbdev, FBIO_WAITFORVSYNC, &screen) < 0) {
        fbdev->waits = errno != ENOTTY && errno != EOPNOTSUPP && errno != EINVAL;
        return fbdev->waits ? failed(fbdev, "FBIO_WAITFORVSYNC") : OW_OK;
    }
    return OW_OK;
}

static int fbdev_lend(void *device, struct ow_panel_buffer *buffer)
{
    struct linux_fbdev *fbdev = device;
    uint32_t held = fbdev->drawn_at[0];
    buffer->pixels = fbdev->beside;
    buffer->stride = fbdev->beside_stride;
    if (fbdev->pages == 2) {
        int status = wait_for_vsync(fbdev); /* until then the page may still be read */
        if (status < 0) {
            return status;
        }
        held = fbdev->drawn_at[1 - fbdev->shown];
        buffer->pixels = page(fbdev, 1 - fbdev->shown);
        buffer->stride = fbdev->stride;
    }
    buffer->age = held == 0 ? 0 : fbdev->frames + 1 - held;
    fbdev->lent = true;
    return OW_OK;
}

static void copy_rect(struct linux_fbdev *fbdev, const struct ow_panel_rect *rect)
{
    size_t bytes = fbdev->info.format->bits / 8u;
    size_t left = rect->x * bytes;
    for (uint32_t y = rect->y; y < (uint32_t)rect->y + rect->height; y++) {
        memcpy(fbdev->screen + (size_t)y * fbdev->stride + left,
               fbdev->beside + (size_t)y * fbdev->beside_stride + left, rect->width * bytes);
    }
}

static int fbdev_show(void *device, const struct ow_panel_rect *changed, uint32_t count)
{
    struct linux_fbdev *fbdev = device;
    uint32_t drawn = fbdev->pages == 2 ? 1 - fbdev->shown : 0;
    if (!fbdev->lent) {
        return OW_ARGUMENT;
    }
    fbdev->lent = false;
    fbdev->drawn_at[drawn] = 0;
    if (count == 0) {
        return OW_OK;
    }
    if (fbdev->pages == 2) {
        if (pan_to(fbdev, drawn) < 0) {
            return failed(fbdev, "FBIOPAN_DISPLAY");
        }
        fbdev->shown = drawn;
    } else {
        int status = wait_for_vsync(fbdev);
        if (status < 0) {
            return status;
        }
        for (uint32_t i = 0; i < count; i++) {
            copy_rect(fbdev, &changed[i]);
        }
    }
    if (linux_map_is_lost(fbdev->memory)) {
        return linux_fault_note(&fbdev->fault, OW_GONE, fbdev->config.device, NULL,
                                "the device's memory is gone, it was unplugged",
                                "connect it again");
    }
    fbdev->drawn_at[drawn] = ++fbdev->frames;
    return OW_OK;
}

const struct ow_panel_ops linux_fbdev_ops = {
    .info = fbdev_info,
    .lend = fbdev_lend,
    .show = fbdev_show,
};
