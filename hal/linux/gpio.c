/* SPDX-License-Identifier: 0BSD */
/*
 * GPIO lines. Each line has a queue of edges of its own in the kernel; here they
 * are merged by their time stamps. Where the kernel does not debounce, edges
 * too near to the last are dropped, and the line is looked at when it is quiet.
 */
#define _GNU_SOURCE /* versionsort */
#include "hal/linux/gpio.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

enum { SECOND_NS = 1000000000, US_NS = 1000, PATH_BYTES = 300 };

void linux_gpio_init(struct linux_gpio *gpio, const struct linux_gpio_config *config)
{
    *gpio = (struct linux_gpio){ .config = *config, .timer = -1 };
    if (gpio->config.folder == NULL) {
        gpio->config.folder = "/dev";
    }
    if (gpio->config.user == NULL) {
        gpio->config.user = "oldwell";
    }
}

/* ---- finding ---- */

/* A line found on an open chip. */
struct found {
    void *chip;
    unsigned offset;
    char chip_name[LINUX_GPIO_NAME];
    char seen[120]; /* the chips that are there, for the remedy */
    int error;      /* of the first chip that could not be opened */
};

static bool number_of(const char *text, unsigned long *number)
{
    char *end = NULL;
    if (text == NULL || text[0] < '0' || text[0] > '9') {
        return false;
    }
    errno = 0;
    *number = strtoul(text, &end, 10);
    return errno == 0 && *end == '\0';
}

/* Is it the chip that the request means: by name, path, number or label? */
static bool chip_fits(const struct linux_gpio *gpio, void *chip, const char *path,
                      const char *wanted)
{
    char text[LINUX_GPIO_NAME];
    unsigned long number;
    if (wanted == NULL || strcmp(wanted, path) == 0) {
        return true;
    }
    gpio->config.lib->chip_name(chip, text, sizeof text);
    if (strcmp(text, wanted) == 0) {
        return true;
    }
    if (number_of(wanted, &number)) {
        char name[LINUX_GPIO_NAME];
        snprintf(name, sizeof name, "gpiochip%lu", number);
        return strcmp(text, name) == 0;
    }
    gpio->config.lib->chip_label(chip, text, sizeof text);
    return strcmp(text, wanted) == 0;
}

/* The line's offset on a chip: by name, else by number where a chip was named; -1: not there. */
static long offset_on(const struct linux_gpio *gpio, void *chip, const struct ow_gpio_request *wish)
{
    unsigned long number;
    int offset = gpio->config.lib->find_line(chip, wish->line);
    if (offset >= 0) {
        return offset;
    }
    if (wish->chip != NULL && number_of(wish->line, &number) &&
        number < gpio->config.lib->chip_lines(chip)) {
        return (long)number;
    }
    return -1;
}

static void note_chip(const struct linux_gpio *gpio, void *chip, struct found *found)
{
    char label[LINUX_GPIO_NAME];
    size_t used = strlen(found->seen);
    gpio->config.lib->chip_name(chip, found->chip_name, sizeof found->chip_name);
    gpio->config.lib->chip_label(chip, label, sizeof label);
    snprintf(found->seen + used, sizeof found->seen - used, "%s%s [%s]", used > 0 ? ", " : "",
             found->chip_name, label);
}

/* 1: found, and the chip stays open; 0: not on this chip; -1: it is the chip, without the line. */
static int look_at(const struct linux_gpio *gpio, const char *path,
                   const struct ow_gpio_request *wish, struct found *found)
{
    const struct linux_gpio_lib *lib = gpio->config.lib;
    void *chip = lib->chip_open(path);
    if (chip == NULL) {
        found->error = found->error == 0 ? errno : found->error;
        return 0;
    }
    note_chip(gpio, chip, found);
    bool fits = chip_fits(gpio, chip, path, wish->chip);
    long offset = fits ? offset_on(gpio, chip, wish) : -1;
    if (offset < 0) {
        lib->chip_close(chip);
        return fits && wish->chip != NULL ? -1 : 0;
    }
    found->chip = chip;
    found->offset = (unsigned)offset;
    return 1;
}

static int is_chip(const struct dirent *entry)
{
    return strncmp(entry->d_name, "gpiochip", 8) == 0;
}

/* Looks at all chips in the order of their numbers. */
static int find(const struct linux_gpio *gpio, const struct ow_gpio_request *wish,
                struct found *found)
{
    struct dirent **entries = NULL;
    int count = scandir(gpio->config.folder, &entries, is_chip, versionsort);
    int result = 0;
    for (int i = 0; i < count; i++) {
        if (result == 0) {
            char path[PATH_BYTES];
            snprintf(path, sizeof path, "%s/%s", gpio->config.folder, entries[i]->d_name);
            result = look_at(gpio, path, wish, found);
        }
        free(entries[i]);
    }
    free(entries);
    return result;
}

static int not_found(struct linux_gpio *gpio, const struct ow_gpio_request *wish,
                     const struct found *found, const char *name, int result)
{
    struct linux_fault *fault = &gpio->fault;
    if (result == 0 && found->error != 0) {
        return linux_fault_errno(fault, name, "gpiod_chip_open", found->error);
    }
    if (result < 0) {
        (void)linux_fault_note(fault, OW_GONE, name, NULL, "there is no such line on this chip",
                               "");
        linux_fault_remedy(fault, "name one that `gpioinfo %s` lists", found->chip_name);
        return OW_GONE;
    }
    (void)linux_fault_note(fault, OW_GONE, name, NULL,
                           wish->chip != NULL ? "there is no such chip"
                                              : "no chip has a line of this name",
                           "load the driver of the GPIO chip");
    if (found->seen[0] != '\0') {
        linux_fault_remedy(fault, "name one of: %s", found->seen);
    }
    return OW_GONE;
}

/* ---- opening ---- */

static int check_request(struct linux_gpio *gpio, const struct ow_gpio_request *request,
                         const char *name)
{
    const char *wrong = NULL;
    if (gpio->config.lib == NULL) {
        return linux_fault_note(&gpio->fault, OW_UNSUPPORTED, name, NULL,
                                "this program was built without libgpiod",
                                "install libgpiod-dev and build it anew");
    }
    unsigned long number;
    if (request->line == NULL || request->line[0] == '\0') {
        wrong = "no line is named";
    } else if (request->chip == NULL && number_of(request->line, &number)) {
        wrong = "a line's number needs its chip";
    } else if (request->direction == OW_GPIO_OUTPUT && request->edges != 0) {
        wrong = "an output reports no edges";
    }
    return wrong == NULL
               ? OW_OK
               : linux_fault_note(&gpio->fault, OW_ARGUMENT, name, NULL, wrong, "give CHIP:LINE");
}

static int make_timer(struct linux_gpio *gpio)
{
    if (gpio->timer >= 0) {
        return OW_OK;
    }
    gpio->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    return gpio->timer >= 0 ? OW_OK
                            : linux_fault_errno(&gpio->fault, "gpio", "timerfd_create", errno);
}

static int request_failed(struct linux_gpio *gpio, const struct found *found, const char *name,
                          int number)
{
    char user[LINUX_GPIO_NAME];
    int status = linux_fault_errno(&gpio->fault, name, "request line", number);
    if (number == EINVAL || number == ENOTSUP) {
        status = linux_fault_note(&gpio->fault, OW_UNSUPPORTED, name, "request line",
                                  "the chip refuses this pull, edge or direction",
                                  "use a resistor instead of a pull, or another line");
    }
    gpio->config.lib->line_user(found->chip, found->offset, user, sizeof user);
    if (status == OW_BUSY && user[0] != '\0') {
        linux_fault_remedy(&gpio->fault, "it is used by \"%s\": end that or take another line",
                           user);
    }
    return status;
}

static int take_line(struct linux_gpio *gpio, int slot, const struct found *found,
                     const struct ow_gpio_request *request, const char *name)
{
    const struct linux_gpio_lib *lib = gpio->config.lib;
    bool ours = request->debounce_us != 0 && !lib->debounces && request->edges != 0;
    struct ow_gpio_request wish = *request;
    if (ours) { /* both edges are needed to know the level */
        wish.edges = OW_GPIO_RISING | OW_GPIO_FALLING;
        int status = make_timer(gpio);
        if (status < 0) {
            return status;
        }
    }
    void *line = lib->line_request(found->chip, found->offset, &wish, gpio->config.user);
    if (line == NULL) {
        return request_failed(gpio, found, name, errno);
    }
    gpio->lines[slot] = (struct linux_gpio_line){
        .chip = found->chip,
        .line = line,
        .edges = request->edges,
        .debounce_ns = ours ? (uint64_t)request->debounce_us * US_NS : 0,
        .level = lib->line_get(line) == 1,
    };
    snprintf(gpio->lines[slot].name, sizeof gpio->lines[slot].name, "%s", name);
    return slot;
}

static int gpio_open(void *device, const struct ow_gpio_request *request)
{
    struct linux_gpio *gpio = device;
    struct found found = { .chip = NULL };
    char name[LINUX_GPIO_NAME + 32];
    snprintf(name, sizeof name, "gpio %.40s%s%.40s", request->chip != NULL ? request->chip : "",
             request->chip != NULL ? ":" : "", request->line != NULL ? request->line : "");
    int status = check_request(gpio, request, name);
    if (status != OW_OK) {
        return status;
    }
    int slot = 0;
    while (slot < LINUX_GPIO_LINES && gpio->lines[slot].line != NULL) {
        slot++;
    }
    if (slot == LINUX_GPIO_LINES) {
        return linux_fault_note(&gpio->fault, OW_CAPACITY, name, NULL, "too many lines are open",
                                "use fewer");
    }
    int result = find(gpio, request, &found);
    if (result <= 0) {
        return not_found(gpio, request, &found, name, result);
    }
    status = take_line(gpio, slot, &found, request, name);
    if (status < 0) {
        gpio->config.lib->chip_close(found.chip);
    }
    return status;
}

/* ---- use ---- */

/* The open line of this number; NULL and a status where there is none. */
static struct linux_gpio_line *line_of(struct linux_gpio *gpio, int line)
{
    return line >= 0 && line < LINUX_GPIO_LINES && gpio->lines[line].line != NULL
               ? &gpio->lines[line]
               : NULL;
}

static int gpio_get(void *device, int number)
{
    struct linux_gpio *gpio = device;
    const struct linux_gpio_line *line = line_of(gpio, number);
    if (line == NULL) {
        return OW_ARGUMENT;
    }
    int level = gpio->config.lib->line_get(line->line);
    return level >= 0 ? level : linux_fault_errno(&gpio->fault, line->name, "get value", errno);
}

static int gpio_set(void *device, int number, bool level)
{
    struct linux_gpio *gpio = device;
    const struct linux_gpio_line *line = line_of(gpio, number);
    if (line == NULL) {
        return OW_ARGUMENT;
    }
    return gpio->config.lib->line_set(line->line, level) >= 0
               ? OW_OK
               : linux_fault_errno(&gpio->fault, line->name, "set value", errno);
}

static int gpio_close(void *device, int number)
{
    struct linux_gpio *gpio = device;
    struct linux_gpio_line *line = line_of(gpio, number);
    if (line == NULL) {
        return OW_ARGUMENT;
    }
    gpio->config.lib->line_release(line->line);
    gpio->config.lib->chip_close(line->chip);
    *line = (struct linux_gpio_line){ .line = NULL };
    return OW_OK;
}

void linux_gpio_close(struct linux_gpio *gpio)
{
    for (int i = 0; i < LINUX_GPIO_LINES; i++) {
        (void)gpio_close(gpio, i);
    }
    if (gpio->timer >= 0) {
        (void)close(gpio->timer);
        gpio->timer = -1;
    }
}

int linux_gpio_fd(const struct linux_gpio *gpio, int number)
{
    bool open = number >= 0 && number < LINUX_GPIO_LINES && gpio->lines[number].line != NULL;
    return open && gpio->lines[number].edges != 0
               ? gpio->config.lib->line_fd(gpio->lines[number].line)
               : -1;
}

int linux_gpio_timer_fd(const struct linux_gpio *gpio)
{
    return gpio->timer;
}

/* ---- edges ---- */

static uint64_t now_ns(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * SECOND_NS + (uint64_t)now.tv_nsec;
}

static bool is_reported(const struct linux_gpio_line *line, bool level)
{
    return (line->edges & (level ? OW_GPIO_RISING : OW_GPIO_FALLING)) != 0;
}

/* Have the timer wake the waiting loop when the first unsure line is quiet. */
static void set_timer(const struct linux_gpio *gpio)
{
    uint64_t first_ns = 0;
    if (gpio->timer < 0) {
        return;
    }
    for (int i = 0; i < LINUX_GPIO_LINES; i++) {
        const struct linux_gpio_line *line = &gpio->lines[i];
        if (line->unsure && (first_ns == 0 || line->quiet_ns < first_ns)) {
            first_ns = line->quiet_ns;
        }
    }
    const struct itimerspec at = { .it_value = { (time_t)(first_ns / SECOND_NS),
                                                 (long)(first_ns % SECOND_NS) } };
    (void)timerfd_settime(gpio->timer, TFD_TIMER_ABSTIME, &at, NULL);
}

/* Whether an edge counts. One that does not makes the line unsure. */
static bool believe(struct linux_gpio_line *line, const struct linux_gpio_edge *edge)
{
    if (line->debounce_ns == 0) {
        return true;
    }
    if (edge->time_ns < line->quiet_ns) {
        line->unsure = true;
        return false;
    }
    line->quiet_ns = edge->time_ns + line->debounce_ns;
    line->unsure = false;
    bool changes = edge->level != line->level;
    line->level = edge->level;
    return changes && is_reported(line, edge->level);
}

/* An unsure line that is quiet now: the level that it has come to. */
static bool settle(struct linux_gpio *gpio, struct linux_gpio_line *line)
{
    if (!line->unsure || now_ns() < line->quiet_ns) {
        return false;
    }
    bool level = gpio->config.lib->line_get(line->line) == 1;
    line->unsure = false;
    if (level == line->level) {
        return false;
    }
    line->edge = (struct linux_gpio_edge){ .time_ns = line->quiet_ns, .level = level };
    line->level = level;
    line->quiet_ns += line->debounce_ns;
    return is_reported(line, level);
}

/* Reads a line's next edge that counts. 1: one waits; 0: none; or a status. */
static int read_edge(struct linux_gpio *gpio, struct linux_gpio_line *line)
{
    struct linux_gpio_edge edge;
    int ready;
    while ((ready = gpio->config.lib->line_edge(line->line, &edge)) > 0) {
        if (edge.number != 0) {
            gpio->lost = gpio->lost || (line->number != 0 && edge.number != line->number + 1);
            line->number = edge.number;
        }
        if (believe(line, &edge)) {
            line->edge = edge;
            line->waits = true;
            return 1;
        }
    }
    if (ready < 0) {
        return linux_fault_errno(&gpio->fault, line->name, "read edge", errno);
    }
    line->waits = settle(gpio, line);
    return line->waits;
}

/*
 * Reads until every line that has an edge shows its oldest: an edge that came
 * to one line while another was read may be older, so it goes round again until
 * nothing new is there.
 */
static int read_all(struct linux_gpio *gpio)
{
    int found;
    do {
        found = 0;
        for (int i = 0; i < LINUX_GPIO_LINES; i++) {
            struct linux_gpio_line *line = &gpio->lines[i];
            if (line->line == NULL || line->edges == 0 || line->waits) {
                continue;
            }
            int status = read_edge(gpio, line);
            if (status < 0) {
                return status;
            }
            found += status;
        }
    } while (found > 0);
    set_timer(gpio);
    return OW_OK;
}

static int gpio_event(void *device, struct ow_gpio_event *event)
{
    struct linux_gpio *gpio = device;
    uint64_t expired;
    if (gpio->timer >= 0) {
        (void)!read(gpio->timer, &expired, sizeof expired);
    }
    int status = read_all(gpio);
    if (status < 0) {
        return status;
    }
    if (gpio->lost) {
        gpio->lost = false;
        return OW_CAPACITY;
    }
    struct linux_gpio_line *oldest = NULL;
    for (int i = 0; i < LINUX_GPIO_LINES; i++) {
        struct linux_gpio_line *line = &gpio->lines[i];
        if (line->waits && (oldest == NULL || line->edge.time_ns < oldest->edge.time_ns)) {
            oldest = line;
        }
    }
    if (oldest == NULL) {
        return OW_AGAIN;
    }
    oldest->waits = false;
    event->time_us = oldest->edge.time_ns / US_NS;
    event->line = (int)(oldest - gpio->lines);
    event->level = oldest->edge.level;
    return OW_OK;
}

const struct ow_gpio_ops linux_gpio_ops = {
    .open = gpio_open,
    .get = gpio_get,
    .set = gpio_set,
    .event = gpio_event,
    .close = gpio_close,
};
