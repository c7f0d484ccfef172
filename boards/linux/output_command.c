/* SPDX-License-Identifier: 0BSD */
/* --panel ili9341 and the other controllers, on SPI or I2C. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/clock.h"
#include "hal/linux/gpio.h"
#include "hal/linux/i2cdev.h"
#include "hal/linux/spidev.h"
#include "hal/panel/command_panel.h"
#include "output.h"

enum { STAGING_BYTES = 1 << 16, NONE = -1 };

/* All of the one panel. */
static struct {
    struct linux_gpio gpio;
    struct ow_gpio lines;
    struct linux_spidev spidev;
    struct linux_i2cdev i2cdev;
    struct ow_bus bus;
    struct ow_clock clock;
    struct ow_command_panel panel;
    uint8_t *frame;
    uint8_t *staging;
    int data;
    int reset;
    int backlight;
    bool on_i2c;
    bool stays; /* the picture is to be seen when the program has left */
} the;

static struct linux_fault *bus_fault(void)
{
    return the.on_i2c ? &the.i2cdev.fault : &the.spidev.fault;
}

/* ---- lines ---- */

/* Opens [!][CHIP:]LINE as an output, low; NULL: none. The line, NONE, or a status below that. */
static int open_line(const char *text, bool active_low)
{
    char chip[LINUX_GPIO_NAME];
    struct ow_gpio_request request = { .direction = OW_GPIO_OUTPUT, .active_low = active_low };
    if (text == NULL) {
        return NONE;
    }
    if (text[0] == '!') {
        request.active_low = !active_low;
        text++;
    }
    const char *colon = strrchr(text, ':');
    request.line = colon != NULL ? colon + 1 : text;
    if (colon != NULL) {
        snprintf(chip, sizeof chip, "%.*s", (int)(colon - text), text);
        request.chip = chip;
    }
    int line = linux_gpio_ops.open(&the.gpio, &request);
    return line >= 0 ? line : line - 1; /* so that no status is NONE */
}

static int open_lines(const struct oldwell_settings *settings)
{
    const struct linux_gpio_config config = { .lib = linux_gpio_installed };
    linux_gpio_init(&the.gpio, &config);
    the.lines = (struct ow_gpio){ &linux_gpio_ops, &the.gpio };
    the.data = the.on_i2c ? NONE : open_line(settings->dc, false);
    the.reset = the.data >= NONE ? open_line(settings->reset, true) : NONE;
    the.backlight =
        the.data >= NONE && the.reset >= NONE ? open_line(settings->backlight, false) : NONE;
    int worst = the.data < the.reset ? the.data : the.reset;
    worst = the.backlight < worst ? the.backlight : worst;
    if (worst < NONE) {
        *bus_fault() = the.gpio.fault;
        return worst + 1;
    }
    return OW_OK;
}

/* ---- bus ---- */

static int open_bus(const struct oldwell_settings *settings, const struct linux_system *system,
                    const struct ow_controller *controller)
{
    const char *device = settings->device;
    if (the.on_i2c) {
        const struct linux_i2cdev_config config = {
            .system = system,
            .device = device,
            .address = settings->i2c_address,
            .gpio = the.reset >= 0 ? &the.lines : NULL,
            .reset = the.reset,
        };
        the.bus = (struct ow_bus){ &linux_i2cdev_ops, &the.i2cdev };
        return linux_i2cdev_open(&the.i2cdev, &config);
    }
    const struct linux_spidev_config config = {
        .system = system,
        .device = device,
        .clock_hz = settings->spi_hz != 0 ? (uint32_t)settings->spi_hz : controller->write_hz,
        .mode = (uint8_t)settings->spi_mode,
        .gpio = &the.lines,
        .data = the.data,
        .reset = the.reset,
    };
    the.bus = (struct ow_bus){ &linux_spidev_ops, &the.spidev };
    return linux_spidev_open(&the.spidev, &config);
}

static void close_all(void)
{
    if (the.on_i2c) {
        linux_i2cdev_close(&the.i2cdev);
    } else {
        linux_spidev_close(&the.spidev);
    }
    linux_gpio_close(&the.gpio);
    free(the.frame);
    free(the.staging);
    the.frame = the.staging = NULL;
}

/* ---- panel ---- */

static void configure(struct ow_command_panel_config *config,
                      const struct oldwell_settings *settings,
                      const struct ow_controller *controller)
{
    ow_command_panel_defaults(config, controller);
    if (settings->has_size) {
        config->width = (uint16_t)settings->size[0];
        config->height = (uint16_t)settings->size[1];
    }
    if (settings->has_offset) {
        config->offset_x = settings->offset[0];
        config->offset_y = settings->offset[1];
    }
    config->bgr = settings->bgr;
    config->inverted =
        settings->invert == INVERT_AUTO ? config->inverted : settings->invert == INVERT_YES;
    config->mirror_x = settings->mirror_x;
    config->mirror_y = settings->mirror_y;
    config->bus = &the.bus;
    config->clock = &the.clock;
    config->gpio = the.backlight >= 0 ? &the.lines : NULL;
    config->backlight = the.backlight;
}

static int open_panel(const struct oldwell_settings *settings, const struct linux_system *system,
                      const struct ow_controller *controller)
{
    struct ow_command_panel_config config;
    const char *device = settings->device;
    the.clock = (struct ow_clock){ &linux_clock_ops, (void *)(uintptr_t)system };
    configure(&config, settings, controller);
    config.frame_bytes = ow_command_panel_frame_bytes(&config);
    config.staging_bytes = STAGING_BYTES;
    the.frame = calloc(1, config.frame_bytes);
    the.staging = malloc(STAGING_BYTES);
    if (the.frame == NULL || the.staging == NULL) {
        return linux_fault_note(bus_fault(), OW_MEMORY, device, NULL,
                                "not enough memory for a frame", "");
    }
    config.frame = the.frame;
    config.staging = the.staging;
    int status = ow_command_panel_open(&the.panel, &config);
    if (status == OW_ARGUMENT) {
        return linux_fault_note(bus_fault(), status, device, NULL,
                                "size and offset do not suit this controller",
                                "give the glass's own --size and --offset");
    }
    if (status == OW_OK) {
        status = ow_command_panel_start(&the.panel);
    }
    if (status < 0 && bus_fault()->status != status) {
        linux_fault_note(bus_fault(), status, device, NULL, ow_status_text(status),
                         "check the wiring");
    }
    return status;
}

static int open_command(struct output *output, const struct oldwell_settings *settings,
                        const struct linux_system *system)
{
    const struct ow_controller *controller = ow_controllers[settings->panel - PANEL_COMMAND];
    the.on_i2c = settings->on_i2c;
    the.stays = settings->once;
    the.spidev.fd = the.i2cdev.fd = -1;
    *bus_fault() = (struct linux_fault){ .status = OW_OK };
    int status = open_lines(settings);
    if (status == OW_OK) {
        status = open_bus(settings, system, controller);
    }
    if (status == OW_OK) {
        status = open_panel(settings, system, controller);
    }
    output->fault = bus_fault();
    output->panel = the.panel.panel;
    output->uses_changes = true;
    if (status < 0) {
        close_all();
    }
    return status;
}

static void close_command(struct output *output)
{
    (void)output;
    if (!the.stays) {
        (void)ow_command_panel_close(&the.panel);
    }
    close_all();
}

static void examine_command(const struct output *output, struct report *report)
{
    struct ow_bus_limits limits = { 0 };
    (void)output;
    if (the.bus.ops->limits(the.bus.device, &limits) != OW_OK) {
        return;
    }
    uint32_t frame =
        ow_row_bytes(the.panel.config.format, the.panel.config.width) * the.panel.config.height;
    report_note(report, "bus", "%u Hz, at most %u bytes a transfer, %u a frame", limits.clock_hz,
                limits.max_bytes, frame);
    if (limits.clock_hz > 0) {
        report_note(report, "bus", "a whole frame takes %u ms at least",
                    (unsigned)((uint64_t)frame * 8000 / limits.clock_hz));
    }
    uint8_t answer = 0;
    int asked = ow_command_panel_ask(&the.panel, &answer);
    if (asked == 1) {
        report_good(report, "answer", "the controller says 0x%02x: awake", answer);
    } else if (asked == 0) {
        report_note(report, "answer",
                    "the controller says 0x%02x: either MISO is not connected, as on many modules, "
                    "or it did not understand",
                    answer);
    }
    if (!the.on_i2c && limits.max_bytes <= 4096 && frame > 4096) {
        report_note(report, "bufsiz",
                    "spidev.bufsiz=65536 on the kernel's command line makes transfers longer");
    }
}

const struct output_kind output_command = {
    .open = open_command,
    .close = close_command,
    .examine = examine_command,
};
