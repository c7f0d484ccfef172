/* SPDX-License-Identifier: 0BSD */
/* GPIO on a libgpiod that is made up: finding lines, refusals, edges in the order of time. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "hal/linux/gpio.h"
#include "tests/unit/child.h"

enum { CHIPS = 3, LINES = 8, EDGES = 32 };

struct fake_line {
    const char *name;
    const char *user;
    bool requested;
    struct ow_gpio_request request;
    int level;
    struct linux_gpio_edge edges[EDGES];
    uint32_t head, tail;
    uint32_t number;
};

static struct fake_chip {
    const char *name;
    const char *label;
    struct fake_line lines[LINES];
    int open;
} chips[CHIPS];

static struct {
    int chip_errno;    /* opening a chip fails */
    int request_errno; /* so does a request, */
    int use_errno;     /* so do get, set and reading edges */
    char user[32];
    void (*on_read)(void); /* something happens while edges are read */
} fake;

static char folder[CHILD_PATH];

static const char *version(void)
{
    return "made up";
}

static void *chip_open(const char *path)
{
    for (int i = 0; i < CHIPS; i++) {
        if (fake.chip_errno == 0 && strcmp(strrchr(path, '/') + 1, chips[i].name) == 0) {
            chips[i].open++;
            return &chips[i];
        }
    }
    errno = fake.chip_errno != 0 ? fake.chip_errno : ENOENT;
    return NULL;
}

static void chip_close(void *chip)
{
    ((struct fake_chip *)chip)->open--;
}

static void chip_name(void *chip, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s", ((struct fake_chip *)chip)->name);
}

static void chip_label(void *chip, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s", ((struct fake_chip *)chip)->label);
}

static unsigned chip_lines(void *chip)
{
    (void)chip;
    return LINES;
}

static int find_line(void *context, const char *name)
{
    const struct fake_chip *chip = context;
    for (int i = 0; i < LINES; i++) {
        if (chip->lines[i].name != NULL && strcmp(chip->lines[i].name, name) == 0) {
            return i;
        }
    }
    errno = ENOENT;
    return -1;
}

static void line_user(void *chip, unsigned offset, char *text, size_t bytes)
{
    const char *user = ((struct fake_chip *)chip)->lines[offset].user;
    snprintf(text, bytes, "%s", user != NULL ? user : "");
}

static void *line_request(void *chip, unsigned offset, const struct ow_gpio_request *request,
                          const char *user)
{
    struct fake_line *line = &((struct fake_chip *)chip)->lines[offset];
    assert_true(((struct fake_chip *)chip)->open > 0);
    if (fake.request_errno != 0 || line->user != NULL) {
        errno = fake.request_errno != 0 ? fake.request_errno : EBUSY;
        return NULL;
    }
    snprintf(fake.user, sizeof fake.user, "%s", user);
    line->requested = true;
    line->request = *request;
    if (request->direction == OW_GPIO_OUTPUT) {
        line->level = request->level;
    }
    return line;
}

static void line_release(void *line)
{
    ((struct fake_line *)line)->requested = false;
}

static bool use_fails(void)
{
    errno = fake.use_errno;
    return fake.use_errno != 0;
}

static int line_get(void *line)
{
    return use_fails() ? -1 : ((struct fake_line *)line)->level;
}

static int line_set(void *line, bool level)
{
    ((struct fake_line *)line)->level = level;
    return use_fails() ? -1 : 0;
}

static int line_fd(void *line)
{
    for (int i = 0; i < CHIPS; i++) {
        for (int k = 0; k < LINES; k++) {
            if (&chips[i].lines[k] == line) {
                return 100 + 10 * i + k;
            }
        }
    }
    return -1;
}

static int line_edge(void *context, struct linux_gpio_edge *edge)
{
    struct fake_line *line = context;
    if (use_fails()) {
        return -1;
    }
    if (line->head == line->tail) {
        if (fake.on_read != NULL) {
            void (*happens)(void) = fake.on_read;
            fake.on_read = NULL;
            happens();
        }
        return 0;
    }
    *edge = line->edges[line->head++];
    return 1;
}

static struct linux_gpio_lib lib = {
    .version = version,
    .chip_open = chip_open,
    .chip_close = chip_close,
    .chip_name = chip_name,
    .chip_label = chip_label,
    .chip_lines = chip_lines,
    .find_line = find_line,
    .line_user = line_user,
    .line_request = line_request,
    .line_release = line_release,
    .line_get = line_get,
    .line_set = line_set,
    .line_fd = line_fd,
    .line_edge = line_edge,
};

static void happens(struct fake_line *line, uint64_t time_ns, bool level)
{
    line->level = level;
    line->edges[line->tail++] = (struct linux_gpio_edge){ time_ns, ++line->number, level };
}

static void begin(struct linux_gpio *gpio)
{
    memset(chips, 0, sizeof chips);
    memset(&fake, 0, sizeof fake);
    lib.debounces = true;
    chips[0].name = "gpiochip0";
    chips[0].label = "pinctrl";
    chips[1].name = "gpiochip2";
    chips[1].label = "expander";
    chips[2].name = "gpiochip10";
    chips[2].label = "7";
    chips[0].lines[3].name = "DC";
    chips[1].lines[5].name = "RESET";
    chips[1].lines[6].name = "2";
    chips[2].lines[0].name = "DC";
    chips[2].lines[4].user = "somebody else";
    const struct linux_gpio_config config = { &lib, folder, NULL };
    linux_gpio_init(gpio, &config);
}

static void end(struct linux_gpio *gpio)
{
    linux_gpio_close(gpio);
    for (int i = 0; i < CHIPS; i++) {
        assert_int_equal(chips[i].open, 0);
        for (int k = 0; k < LINES; k++) {
            assert_false(chips[i].lines[k].requested);
        }
    }
}

static void lines_are_found(void **state)
{
    static const struct {
        const char *chip;
        const char *line;
        int found[2];
    } wanted[] = {
        { NULL, "DC", { 0, 3 } },
        { NULL, "RESET", { 1, 5 } },
        { "gpiochip10", "DC", { 2, 0 } },
        { "10", "DC", { 2, 0 } },
        { "expander", "RESET", { 1, 5 } },
        { "2", "7", { 1, 7 } },
        { "2", "2", { 1, 6 } }, /* a name comes before a number */
        { "pinctrl", "0", { 0, 0 } },
        { "gpiochip0", "3", { 0, 3 } },
    };
    (void)state;
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        struct linux_gpio gpio;
        begin(&gpio);
        const struct ow_gpio_request request = {
            .chip = wanted[i].chip,
            .line = wanted[i].line,
            .direction = OW_GPIO_OUTPUT,
            .active_low = true,
            .level = true,
        };
        int line = linux_gpio_ops.open(&gpio, &request);
        struct fake_line *found = &chips[wanted[i].found[0]].lines[wanted[i].found[1]];
        assert_int_equal(line, 0);
        assert_true(found->requested && found->request.active_low);
        assert_string_equal(fake.user, "oldwell");
        assert_int_equal(linux_gpio_ops.get(&gpio, line), 1);
        assert_int_equal(linux_gpio_ops.set(&gpio, line, false), OW_OK);
        assert_int_equal(found->level, 0);
        assert_int_equal(linux_gpio_fd(&gpio, line), -1);
        end(&gpio);
    }
}

static void what_cannot_be_opened_is_told(void **state)
{
    static const struct {
        const char *chip;
        const char *line;
        int chip_errno, request_errno;
        int status;
        const char *words;
    } wanted[] = {
        { NULL, "NOWHERE", 0, 0, OW_GONE, "gpiochip0 [pinctrl], gpiochip2 [expander]" },
        { "0", "NOWHERE", 0, 0, OW_GONE, "`gpioinfo gpiochip0`" },
        { "0", "8", 0, 0, OW_GONE, "no such line" },
        { "nochip", "1", 0, 0, OW_GONE, "no such chip" },
        { NULL, "17", 0, 0, OW_ARGUMENT, "needs its chip" },
        { NULL, NULL, 0, 0, OW_ARGUMENT, "no line is named" },
        { NULL, "DC", EACCES, 0, OW_DENIED, "oldwell doctor" },
        { "10", "4", 0, 0, OW_BUSY, "\"somebody else\"" },
        { "0", "0", 0, EINVAL, OW_UNSUPPORTED, "refuses this pull" },
        { "0", "0", 0, ENODEV, OW_GONE, "connect the device" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        struct linux_gpio gpio;
        char text[600];
        begin(&gpio);
        fake.chip_errno = wanted[i].chip_errno;
        fake.request_errno = wanted[i].request_errno;
        const struct ow_gpio_request request = { .chip = wanted[i].chip, .line = wanted[i].line };
        assert_int_equal(linux_gpio_ops.open(&gpio, &request), wanted[i].status);
        linux_fault_text(&gpio.fault, text, sizeof text);
        print_message("# %s\n", text);
        assert_int_equal(gpio.fault.status, wanted[i].status);
        assert_non_null(strstr(text, wanted[i].words));
        end(&gpio);
    }
}

static void failures_in_use_are_told(void **state)
{
    struct linux_gpio gpio;
    struct ow_gpio_event event;
    (void)state;
    begin(&gpio);
    const struct ow_gpio_request request = { .chip = "0", .line = "1", .edges = OW_GPIO_RISING };
    int line = linux_gpio_ops.open(&gpio, &request);
    assert_int_equal(line, 0);
    fake.use_errno = ENODEV;
    assert_int_equal(linux_gpio_ops.get(&gpio, line), OW_GONE);
    assert_int_equal(linux_gpio_ops.event(&gpio, &event), OW_GONE);
    fake.use_errno = EIO;
    assert_int_equal(linux_gpio_ops.set(&gpio, line, true), OW_BUS);
    assert_string_equal(gpio.fault.device, "gpio 0:1");
    assert_int_equal(linux_gpio_ops.get(&gpio, 1), OW_ARGUMENT);
    assert_int_equal(linux_gpio_ops.set(&gpio, -1, true), OW_ARGUMENT);
    assert_int_equal(linux_gpio_ops.close(&gpio, LINUX_GPIO_LINES), OW_ARGUMENT);
    fake.use_errno = 0;
    end(&gpio);
}

static void too_many_lines_are_refused(void **state)
{
    struct linux_gpio gpio;
    (void)state;
    begin(&gpio);
    const struct ow_gpio_request request = { .chip = "0", .line = "1" };
    for (int i = 0; i < LINUX_GPIO_LINES; i++) {
        assert_int_equal(linux_gpio_ops.open(&gpio, &request), i);
    }
    assert_int_equal(linux_gpio_ops.open(&gpio, &request), OW_CAPACITY);
    assert_int_equal(linux_gpio_ops.close(&gpio, 5), OW_OK);
    assert_int_equal(linux_gpio_ops.open(&gpio, &request), 5);
    end(&gpio);
}

static void no_library_is_told(void **state)
{
    struct linux_gpio gpio;
    const struct linux_gpio_config config = { NULL, folder, NULL };
    const struct ow_gpio_request request = { .line = "DC" };
    (void)state;
    linux_gpio_init(&gpio, &config);
    assert_int_equal(linux_gpio_ops.open(&gpio, &request), OW_UNSUPPORTED);
    linux_gpio_close(&gpio);
}

/* ---- edges ---- */

static int open_input(struct linux_gpio *gpio, const char *number, uint8_t edges,
                      uint32_t debounce_us)
{
    const struct ow_gpio_request request = {
        .chip = "0", .line = number, .edges = edges, .debounce_us = debounce_us
    };
    int line = linux_gpio_ops.open(gpio, &request);
    assert_true(line >= 0);
    return line;
}

static void expect(struct linux_gpio *gpio, int line, uint64_t time_us, bool level)
{
    struct ow_gpio_event event;
    assert_int_equal(linux_gpio_ops.event(gpio, &event), OW_OK);
    assert_int_equal(event.line, line);
    assert_int_equal(event.time_us, time_us);
    assert_int_equal(event.level, level);
}

static void expect_nothing(struct linux_gpio *gpio)
{
    struct ow_gpio_event event;
    assert_int_equal(linux_gpio_ops.event(gpio, &event), OW_AGAIN);
}

/* While the second line is read, an older edge comes to the first. */
static void an_older_edge_comes(void)
{
    happens(&chips[0].lines[1], 41000, true);
    happens(&chips[0].lines[2], 42000, false);
}

static void edges_come_in_the_order_of_time(void **state)
{
    struct linux_gpio gpio;
    (void)state;
    begin(&gpio);
    int a = open_input(&gpio, "1", OW_GPIO_RISING | OW_GPIO_FALLING, 0);
    int b = open_input(&gpio, "2", OW_GPIO_RISING | OW_GPIO_FALLING, 0);
    assert_int_equal(linux_gpio_fd(&gpio, a), 101);
    assert_int_equal(linux_gpio_timer_fd(&gpio), -1);
    expect_nothing(&gpio);
    happens(&chips[0].lines[2], 20000, true);
    happens(&chips[0].lines[2], 40000, false);
    happens(&chips[0].lines[1], 10000, true);
    happens(&chips[0].lines[1], 30000, false);
    expect(&gpio, a, 10, true);
    expect(&gpio, b, 20, true);
    expect(&gpio, a, 30, false);
    expect(&gpio, b, 40, false);
    expect_nothing(&gpio);
    fake.on_read = an_older_edge_comes; /* line 1 has been read as empty by then */
    expect(&gpio, a, 41, true);
    expect(&gpio, b, 42, false);
    expect_nothing(&gpio);
    end(&gpio);
}

static void lost_edges_are_told_once(void **state)
{
    struct linux_gpio gpio;
    struct ow_gpio_event event;
    (void)state;
    begin(&gpio);
    int line = open_input(&gpio, "1", OW_GPIO_RISING | OW_GPIO_FALLING, 0);
    happens(&chips[0].lines[1], 1000, true);
    expect(&gpio, line, 1, true);
    chips[0].lines[1].number += 3;
    happens(&chips[0].lines[1], 9000, false);
    assert_int_equal(linux_gpio_ops.event(&gpio, &event), OW_CAPACITY);
    expect(&gpio, line, 9, false);
    expect_nothing(&gpio);
    end(&gpio);
}

static uint64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000 + (uint64_t)now.tv_nsec;
}

/* Without help from the kernel: the first edge at once, the last level when it is quiet. */
static void bouncing_is_taken_away(void **state)
{
    struct linux_gpio gpio;
    (void)state;
    begin(&gpio);
    lib.debounces = false;
    struct fake_line *pin = &chips[0].lines[1];
    int line = open_input(&gpio, "1", OW_GPIO_RISING | OW_GPIO_FALLING, 20000);
    struct pollfd timer = { .fd = linux_gpio_timer_fd(&gpio), .events = POLLIN };
    assert_true(timer.fd >= 0);
    /* Pressed with bounces, released long ago: both are believed. */
    happens(pin, 1000000, true);
    happens(pin, 2000000, false);
    happens(pin, 3000000, true);
    happens(pin, 90000000, false);
    happens(pin, 90500000, true);
    happens(pin, 91000000, false);
    expect(&gpio, line, 1000, true);
    expect(&gpio, line, 90000, false);
    expect_nothing(&gpio);
    assert_int_equal(poll(&timer, 1, 0), 0); /* long quiet, at the level that was told */
    /* A press so short that its end is dropped: the level is looked at when it is quiet. */
    uint64_t now = now_ns();
    happens(pin, now, true);
    happens(pin, now + 5000000, false);
    expect(&gpio, line, now / 1000, true);
    expect_nothing(&gpio);
    assert_int_equal(poll(&timer, 1, 1000), 1);
    expect(&gpio, line, now / 1000 + 20000, false);
    expect_nothing(&gpio);
    assert_int_equal(poll(&timer, 1, 50), 0);
    /* Only falling edges are wanted; both are looked at. */
    end(&gpio);
    begin(&gpio);
    lib.debounces = false;
    line = open_input(&gpio, "1", OW_GPIO_FALLING, 20000);
    assert_int_equal(pin->request.edges, OW_GPIO_RISING | OW_GPIO_FALLING);
    happens(pin, 1000000, true);
    happens(pin, 90000000, false);
    expect(&gpio, line, 90000, false);
    expect_nothing(&gpio);
    end(&gpio);
}

static int make_folder(void **state)
{
    static const char *const names[] = { "gpiochip0", "gpiochip2", "gpiochip10", "gpio", "tty" };
    (void)state;
    folder_make(folder);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[CHILD_PATH];
        folder_path(path, folder, names[i]);
        int fd = open(path, O_CREAT | O_WRONLY, 0600);
        if (fd < 0 || close(fd) != 0) {
            return -1;
        }
    }
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    folder_remove(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_found),
        cmocka_unit_test(what_cannot_be_opened_is_told),
        cmocka_unit_test(failures_in_use_are_told),
        cmocka_unit_test(too_many_lines_are_refused),
        cmocka_unit_test(no_library_is_told),
        cmocka_unit_test(edges_come_in_the_order_of_time),
        cmocka_unit_test(lost_edges_are_told_once),
        cmocka_unit_test(bouncing_is_taken_away),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
