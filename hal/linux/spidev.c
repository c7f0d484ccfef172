/* SPDX-License-Identifier: 0BSD */
/* SPI by spidev. A transfer is at most as long as the driver's buffer, which is a parameter. */
#include "hal/linux/spidev.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/reset_line.h"

enum {
    USUAL_BUFSIZ = 4096, /* spidev's, where its parameter cannot be read */
    SMALLEST = 16,       /* below this a transfer that is too long is an error */
    READ_MAX = 16,       /* bytes */
    READ_HZ = 4000000,
    USUAL_TRANSFER_US = 25,
    SECOND_US = 1000000
};

static const char bufsiz_file[] = "/sys/module/spidev/parameters/bufsiz";

static int failed(struct linux_spidev *spidev, const char *call)
{
    return linux_fault_errno(&spidev->fault, spidev->config.device, call, errno);
}

/* ---- opening ---- */

static uint32_t read_bufsiz(const struct linux_spidev_config *config)
{
    char text[16] = "";
    int fd = config->system->open(config->bufsiz != NULL ? config->bufsiz : bufsiz_file, O_RDONLY);
    if (fd < 0) {
        return USUAL_BUFSIZ;
    }
    ssize_t count = config->system->read(fd, text, sizeof text - 1);
    (void)config->system->close(fd);
    text[count > 0 ? count : 0] = '\0';
    unsigned long value = strtoul(text, NULL, 10);
    return value >= SMALLEST && value <= UINT32_MAX ? (uint32_t)value : USUAL_BUFSIZ;
}

static int refused(struct linux_spidev *spidev, const char *call, const char *remedy)
{
    int number = errno;
    int status = linux_fault_errno(&spidev->fault, spidev->config.device, call, number);
    if (number == EINVAL) {
        status = linux_fault_note(&spidev->fault, OW_UNSUPPORTED, spidev->config.device, call,
                                  "the controller refuses it", remedy);
    }
    return status;
}

static int set_up(struct linux_spidev *spidev)
{
    const struct linux_spidev_config *config = &spidev->config;
    const struct linux_system *system = config->system;
    uint32_t mode = (config->mode & 3u) | (config->lsb_first ? SPI_LSB_FIRST : 0u) |
                    (config->no_select ? SPI_NO_CS : 0u);
    uint8_t bits = 8;
    uint32_t clock_hz = config->clock_hz;
    if (linux_ioctl(system, spidev->fd, SPI_IOC_WR_MODE32, &mode) < 0) {
        return refused(spidev, "SPI_IOC_WR_MODE32", "use --spi-mode 0");
    }
    if (linux_ioctl(system, spidev->fd, SPI_IOC_WR_BITS_PER_WORD, &bits) < 0) {
        return refused(spidev, "SPI_IOC_WR_BITS_PER_WORD", "this bus cannot send bytes");
    }
    if (linux_ioctl(system, spidev->fd, SPI_IOC_WR_MAX_SPEED_HZ, &clock_hz) < 0) {
        return refused(spidev, "SPI_IOC_WR_MAX_SPEED_HZ", "ask for a lower --spi-hz");
    }
    if (linux_ioctl(system, spidev->fd, SPI_IOC_RD_MAX_SPEED_HZ, &spidev->clock_hz) < 0) {
        spidev->clock_hz = 0;
    }
    return OW_OK;
}

static void explain_open(struct linux_spidev *spidev, int status)
{
    if (status == OW_GONE) {
        linux_fault_remedy(&spidev->fault,
                           "enable the bus (Raspberry Pi: dtparam=spi=on) and name its node");
    }
}

int linux_spidev_open(struct linux_spidev *spidev, const struct linux_spidev_config *config)
{
    *spidev = (struct linux_spidev){ .config = *config, .fd = -1, .level = -1 };
    if (config->gpio == NULL || ow_gpio_check(config->gpio) < 0 || config->data < 0 ||
        config->mode > 3 || config->clock_hz == 0) {
        return linux_fault_note(&spidev->fault, OW_ARGUMENT, config->device, NULL,
                                "the D/C line or the clock is missing", "name them");
    }
    spidev->fd = config->system->open(config->device, O_RDWR);
    if (spidev->fd < 0) {
        int status = failed(spidev, "open");
        explain_open(spidev, status);
        return status;
    }
    int status = set_up(spidev);
    if (status < 0) {
        linux_spidev_close(spidev);
        return status;
    }
    spidev->max_bytes = read_bufsiz(config);
    return OW_OK;
}

void linux_spidev_close(struct linux_spidev *spidev)
{
    if (spidev->fd >= 0 && spidev->config.system != NULL) {
        (void)spidev->config.system->close(spidev->fd);
    }
    spidev->fd = -1;
}

/* ---- transfers ---- */

static int transfer(struct linux_spidev *spidev, const uint8_t *bytes, uint32_t count)
{
    struct spi_ioc_transfer message;
    memset(&message, 0, sizeof message);
    message.tx_buf = (uintptr_t)bytes;
    message.len = count;
    message.speed_hz = spidev->config.clock_hz;
    message.bits_per_word = 8;
    return linux_ioctl(spidev->config.system, spidev->fd, SPI_IOC_MESSAGE(1), &message);
}

/* Sends any number of bytes. Where a transfer is too long for the driver, shorter ones go. */
static int send(struct linux_spidev *spidev, const uint8_t *bytes, uint32_t count)
{
    while (count > 0) {
        uint32_t part = count < spidev->max_bytes ? count : spidev->max_bytes;
        if (transfer(spidev, bytes, part) < 0) {
            bool too_long = errno == EMSGSIZE;
            if (too_long && part / 2 >= SMALLEST) {
                spidev->max_bytes = part / 2 & ~3u; /* whole pixels still */
                continue;
            }
            int status = failed(spidev, "SPI_IOC_MESSAGE");
            if (too_long) {
                linux_fault_remedy(&spidev->fault, "load spidev with a larger bufsiz");
            }
            return status;
        }
        bytes += part;
        count -= part;
    }
    return OW_OK;
}

/* D/C; the line keeps its level from transfer to transfer. */
static int set_data(struct linux_spidev *spidev, int level)
{
    const struct ow_gpio *gpio = spidev->config.gpio;
    if (spidev->level == level) {
        return OW_OK;
    }
    spidev->level = -1;
    int status = gpio->ops->set(gpio->device, spidev->config.data, level != 0);
    if (status < 0) {
        return linux_fault_note(&spidev->fault, status, spidev->config.device, "D/C line",
                                "its level cannot be set", "see what the kernel says (dmesg)");
    }
    spidev->level = level;
    return OW_OK;
}

static int spi_command(void *device, uint8_t code, const uint8_t *parameters, uint32_t count,
                       bool as_commands)
{
    struct linux_spidev *spidev = device;
    uint8_t bytes[256] = { code };
    if (count > sizeof bytes - 1) {
        return OW_ARGUMENT;
    }
    if (count > 0) {
        memcpy(bytes + 1, parameters, count);
    }
    int status = set_data(spidev, 0);
    status = status < 0 ? status : send(spidev, bytes, as_commands ? 1 + count : 1);
    if (status < 0 || as_commands || count == 0) {
        return status;
    }
    status = set_data(spidev, 1);
    return status < 0 ? status : send(spidev, bytes + 1, count);
}

static int spi_pixels(void *device, const uint8_t *bytes, uint32_t count)
{
    struct linux_spidev *spidev = device;
    int status = set_data(spidev, 1);
    return status < 0 ? status : send(spidev, bytes, count);
}

/*
 * Chip select stays between the code and the answer. Answers of several bytes
 * come a bit later. Reading is slower than writing in all data sheets.
 */
static int spi_read(void *device, uint8_t code, uint8_t *answer, uint32_t count)
{
    struct linux_spidev *spidev = device;
    struct spi_ioc_transfer messages[2];
    uint8_t bytes[READ_MAX + 1] = { 0 };
    if (count == 0 || count > READ_MAX) {
        return OW_ARGUMENT;
    }
    int status = set_data(spidev, 0);
    if (status < 0) {
        return status;
    }
    memset(messages, 0, sizeof messages);
    for (int i = 0; i < 2; i++) {
        messages[i].speed_hz =
            spidev->config.clock_hz < READ_HZ ? spidev->config.clock_hz : (uint32_t)READ_HZ;
        messages[i].bits_per_word = 8;
    }
    messages[0].tx_buf = (uintptr_t)&code;
    messages[0].len = 1;
    messages[1].rx_buf = (uintptr_t)bytes;
    messages[1].len = count > 1 ? count + 1 : 1;
    if (linux_ioctl(spidev->config.system, spidev->fd, SPI_IOC_MESSAGE(2), messages) < 0) {
        return failed(spidev, "SPI_IOC_MESSAGE");
    }
    for (uint32_t i = 0; i < count; i++) {
        answer[i] = (uint8_t)(count > 1 ? bytes[i] << 1 | bytes[i + 1] >> 7 : bytes[i]);
    }
    return OW_OK;
}

static int spi_reset(void *device, uint32_t hold_us, uint32_t settle_us)
{
    struct linux_spidev *spidev = device;
    const struct linux_spidev_config *config = &spidev->config;
    const struct linux_reset_line line = { config->system, config->gpio, config->reset };
    return linux_reset_pulse(&line, hold_us, settle_us, &spidev->fault, config->device);
}

static int spi_limits(void *device, struct ow_bus_limits *limits)
{
    const struct linux_spidev *spidev = device;
    uint32_t transfer_us = spidev->config.transfer_us;
    transfer_us = transfer_us != 0 ? transfer_us : (uint32_t)USUAL_TRANSFER_US;
    limits->max_bytes = spidev->max_bytes;
    limits->clock_hz = spidev->clock_hz;
    limits->transfer_bytes = (uint32_t)((uint64_t)spidev->clock_hz * transfer_us / 8 / SECOND_US);
    return OW_OK;
}

const struct ow_bus_ops linux_spidev_ops = {
    .command = spi_command,
    .pixels = spi_pixels,
    .read = spi_read,
    .reset = spi_reset,
    .limits = spi_limits,
};
