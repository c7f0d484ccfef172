/* SPDX-License-Identifier: 0BSD */
/*
 * analyser [--dc LINE] [--vcd FILE] < TRACE: a logic analyser for the guest's pins. It reads QEMU's
 * trace of pl061_set_output, decodes 4-wire SPI (mode 0 or 3: bits count at the clock's rising
 * edge) and writes records for tests/vm/lib/bus.py, each as soon as it is known:
 *   byte 0  kind; byte 1  detail; bytes 4-7  length; bytes 8-15  time, microseconds
 *   'D' detail D/C level, followed by length bytes that were sent; time of the first
 *   'E' the end of a transaction (chip select went up)
 *   'P' detail 2 * line + level: a pin outside SPI changed
 *   'X' detail: what a panel would not forgive (enum trouble)
 * All numbers little-endian, as the host that runs the tests is.
 */
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SCK = 0, MOSI = 1, CS = 2, LINES = 8, RUN_MAX = 65536 };
enum { VCD_EDGES = 200000 }; /* enough to compare, not too much for another decoder */

enum trouble { DC_IN_BYTE = 1, CLOCK_WITHOUT_CS = 2, PART_OF_BYTE = 3 };

static struct {
    uint8_t level[LINES];
    int dc;         /* the line that is D/C */
    unsigned shift; /* the bits of the byte so far */
    unsigned bits;
    uint8_t run[RUN_MAX]; /* bytes sent under one D/C level */
    uint32_t run_length;
    uint8_t run_dc;
    uint64_t run_us; /* when its first byte was whole */
    uint64_t now_us;
    uint64_t edges;
    FILE *vcd;
} bus = { .dc = 4 };

static void put(char kind, unsigned detail, const void *data, uint32_t length)
{
    uint8_t head[16] = { (uint8_t)kind, (uint8_t)detail };
    memcpy(head + 4, &length, 4);
    memcpy(head + 8, length > 0 ? &bus.run_us : &bus.now_us, 8);
    if (fwrite(head, sizeof head, 1, stdout) != 1 ||
        (length > 0 && fwrite(data, length, 1, stdout) != 1)) {
        exit(1); /* nobody listens any more */
    }
}

static void end_run(void)
{
    if (bus.run_length > 0) {
        put('D', bus.run_dc, bus.run, bus.run_length);
        bus.run_length = 0;
    }
}

static void take_byte(uint8_t byte)
{
    uint8_t dc = bus.level[bus.dc];
    if (bus.run_length == RUN_MAX || (bus.run_length > 0 && bus.run_dc != dc)) {
        end_run();
    }
    if (bus.run_length == 0) {
        bus.run_dc = dc;
        bus.run_us = bus.now_us;
    }
    bus.run[bus.run_length++] = byte;
}

static void trouble(enum trouble kind)
{
    end_run();
    put('X', kind, NULL, 0);
}

static void clock_edge(bool rising)
{
    if (bus.level[CS]) {
        if (rising) {
            trouble(CLOCK_WITHOUT_CS);
        }
    } else if (rising) {
        bus.shift = bus.shift << 1 | bus.level[MOSI];
        if (++bus.bits == 8) {
            take_byte((uint8_t)bus.shift);
            bus.bits = 0;
        }
    }
}

static void select_edge(bool up)
{
    if (up && bus.bits != 0) {
        trouble(PART_OF_BYTE);
    }
    bus.bits = 0;
    if (up) {
        end_run();
        put('E', 0, NULL, 0);
    }
}

static void edge(unsigned line, uint8_t level)
{
    if (line >= LINES || bus.level[line] == level) {
        return;
    }
    bus.level[line] = level;
    if (bus.vcd != NULL && bus.edges < VCD_EDGES) {
        fprintf(bus.vcd, "#%llu\n%u%c\n", (unsigned long long)++bus.edges * 100, level,
                (char)('!' + line));
    }
    if (line == SCK) {
        clock_edge(level);
    } else if (line == CS) {
        select_edge(level);
    } else if (line != MOSI) {
        if (line == (unsigned)bus.dc && bus.bits != 0) {
            trouble(DC_IN_BYTE);
        }
        end_run();
        put('P', line * 2 + level, NULL, 0);
    }
}

/* The time of a line: "PROCESS@SECONDS.MICROSECONDS:..."; the time now, if it has none. */
static void take_time(const char *line, const char *end)
{
    uint64_t us = 0;
    const char *p = memchr(line, '@', (size_t)(end - line));
    if (p == NULL) {
        struct timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
        us = (uint64_t)now.tv_sec * 1000000U + (uint64_t)now.tv_nsec / 1000U;
    }
    for (; p != NULL && ++p < end && (*p == '.' || (*p >= '0' && *p <= '9'));) {
        us = *p == '.' ? us : us * 10 + (uint64_t)(*p - '0');
    }
    bus.now_us = us;
}

/* One line of the trace: "... setting output LINE to LEVEL". */
static void take_line(const char *line, size_t length)
{
    static const char mark[] = "setting output ";
    const size_t n = sizeof mark - 1;
    const char *p = line;
    const char *end = line + length;
    take_time(line, end);
    while (p + n + 6 <= end && memcmp(p, mark, n) != 0) {
        p++;
    }
    if (p + n + 6 <= end) {
        edge((unsigned)(p[n] - '0'), (uint8_t)(p[n + 5] == '1'));
    }
}

static size_t take_lines(char *text, size_t length)
{
    char *p = text;
    char *end = text + length;
    char *newline;
    while ((newline = memchr(p, '\n', (size_t)(end - p))) != NULL) {
        take_line(p, (size_t)(newline - p));
        p = newline + 1;
    }
    size_t rest = (size_t)(end - p);
    memmove(text, p, rest);
    return rest;
}

static bool open_vcd(const char *path)
{
    static const char *const names[LINES] = { "SCK", "MOSI",  "CS",    "KEY",
                                              "DC",  "RESET", "ENC_A", "ENC_B" };
    bus.vcd = fopen(path, "w");
    if (bus.vcd == NULL) {
        perror(path);
        return false;
    }
    fputs("$timescale 1 ns $end\n$scope module pins $end\n", bus.vcd);
    for (int i = 0; i < LINES; i++) {
        fprintf(bus.vcd, "$var wire 1 %c %s $end\n", (char)('!' + i), names[i]);
    }
    fputs("$upscope $end\n$enddefinitions $end\n#0\n", bus.vcd);
    for (int i = 0; i < LINES; i++) {
        fprintf(bus.vcd, "%u%c\n", bus.level[i], (char)('!' + i));
    }
    return true;
}

int main(int argc, char **argv)
{
    static char text[1 << 16];
    size_t have = 0;
    bus.level[CS] = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--dc") == 0) {
            bus.dc = atoi(argv[i + 1]) % LINES;
        } else if (strcmp(argv[i], "--vcd") != 0 || !open_vcd(argv[i + 1])) {
            return 2;
        }
    }
    for (;;) {
        struct pollfd in = { .fd = STDIN_FILENO, .events = POLLIN };
        if (poll(&in, 1, 5) == 0) { /* quiet: let go of what is known */
            end_run();
            fflush(stdout);
            continue;
        }
        ssize_t n = read(STDIN_FILENO, text + have, sizeof text - have);
        if (n <= 0) {
            break;
        }
        have = take_lines(text, have + (size_t)n);
        if (have == sizeof text) {
            return 1; /* no line is as long as that */
        }
    }
    end_run();
    return fflush(stdout) == 0 && (bus.vcd == NULL || fclose(bus.vcd) == 0) ? 0 : 1;
}
