# SPDX-License-Identifier: 0BSD
"""Controllers of panels, by their data sheets: they obey what comes over the bus.

A model keeps its memory in the order of the glass, as the usual module is looked at, rows from
the top, and notes in `faults` what a real one would not forgive: an unknown command, a wrong
number of parameters, a window outside its memory, a command too soon after reset or waking.
"""

import struct


class Controller:
    """What all have in common: commands with parameters, and how they are told apart."""

    parameters = {}          # code: number of parameters
    as_commands = False      # parameters come with D/C low
    reset_us = 5000          # from RESET's end to the first command
    wake = (0, 0)            # a code, and the microseconds that nothing may follow it

    def __init__(self, width, height, columns, rows, offset=(0, 0)):
        """Glass of width x height in a memory of columns x rows, from the offset on."""
        self.width, self.height = width, height
        self.columns, self.rows, self.offset = columns, rows, offset
        self.memory = [0] * (columns * rows)
        self.faults = []
        self.log = []         # (code, parameters)
        self.resets = self.pixels = self.windows = 0
        self.low_since = None
        self.power_on(0)

    def fault(self, text):
        if len(self.faults) < 20:
            self.faults.append(text)

    def power_on(self, time_us):
        self.code, self.args, self.left_over = None, bytearray(), b""
        self.not_before = time_us
        self.on = self.inverted = False
        self.window = [0, self.columns - 1, 0, self.rows - 1]
        self.x = self.y = 0

    def reset_pin(self, level, time_us):
        if not level:
            self.low_since = time_us
        elif self.low_since is not None:
            if self.low_since > 0:               # or it was low from the beginning
                self.resets += 1
                if time_us - self.low_since < 10:
                    self.fault("RESET too short")
            self.power_on(time_us + self.reset_us)

    def data(self, dc, content, time_us):
        if dc:
            if self.writes():
                self.store(self.left_over + content)
            elif self.as_commands or self.code is None:
                self.fault(f"{len(content)} bytes of data without a command")
            else:
                self.take(content)
            return
        for byte in content:
            if self.as_commands and self.code is not None and \
                    len(self.args) < self.parameters.get(self.code, 0):
                self.take(bytes([byte]))
            else:
                self.command(byte, time_us)

    def command(self, code, time_us):
        self.finish()
        if time_us < self.not_before:
            self.fault(f"command {code:02x} {self.not_before - time_us} us too soon")
        self.not_before = 0
        if code not in self.parameters:
            self.fault(f"unknown command {code:02x}")
        if code == self.wake[0]:
            self.not_before = time_us + self.wake[1]
        self.code, self.args, self.left_over = code, bytearray(), b""
        self.begin(code, time_us)
        if self.parameters.get(code) == 0 and not self.writes():
            self.finish()

    def finish(self):
        """The command before has ended."""
        if self.code is None:
            return
        wanted = self.parameters.get(self.code, len(self.args))
        if len(self.args) != wanted:
            self.fault(f"command {self.code:02x} with {len(self.args)} parameters, not {wanted}")
        if self.left_over:
            self.fault("part of a pixel")
        self.log.append((self.code, bytes(self.args)))
        self.code = None

    def take(self, content):
        self.args += content
        if len(self.args) == self.parameters.get(self.code):
            self.act(self.code, self.args)
            if self.as_commands:
                self.finish()

    def set_window(self, at, first, last, limit):
        """One axis of the window: at 0 the columns, at 2 the rows."""
        if first > last or last >= limit:
            self.fault(f"window {first}..{last} of {limit}")
            return
        self.window[at:at + 2] = first, last
        self.x, self.y = self.window[0], self.window[2]
        self.windows += at == 0

    def runs(self, count):
        """Cuts so many elements into (x, y, from, number) of one row of the window each."""
        left, right, top, bottom = self.window
        at = 0
        while at < count:
            n = min(count - at, right - self.x + 1)
            yield self.x, self.y, at, n
            at += n
            self.x += n
            if self.x > right:
                self.x = left
                self.y = top if self.y == bottom else self.y + 1

    def glass(self):
        """The visible pixels, rows from the top."""
        left, top = self.offset
        out = []
        for row in range(top, top + self.height):
            out += self.memory[row * self.columns + left:row * self.columns + left + self.width]
        return out


class Mipi(Controller):
    """16-bit colour, high byte first: columns by 2A, rows by 2B, pixels by 2C."""

    parameters = {0x00: 0, 0x01: 0, 0x10: 0, 0x11: 0, 0x13: 0, 0x20: 0, 0x21: 0, 0x28: 0,
                  0x29: 0, 0x2a: 4, 0x2b: 4, 0x2c: 0, 0x36: 1, 0x3a: 1}
    wake = (0x11, 5000)
    upright = 0x00           # MADCTL as the usual module wants it
    sleeps = True

    def __init__(self, *size, **options):
        self.madctl, self.depth, self.awake = 0, None, False
        super().__init__(*size, **options)

    def power_on(self, time_us):
        super().power_on(time_us)
        self.madctl, self.depth, self.awake = 0, None, False

    def writes(self):
        return self.code == 0x2c

    def begin(self, code, time_us):
        if code == 0x01:
            self.power_on(time_us + self.reset_us)
            self.code = code
        elif code == 0x2c:
            self.x, self.y = self.window[0], self.window[2]
            if self.depth not in (0x05, 0x55):
                self.fault(f"pixels of depth {self.depth}")
        elif code in (0x10, 0x11):
            self.awake = code == 0x11
        elif code in (0x28, 0x29):
            self.on = code == 0x29
        elif code in (0x20, 0x21):
            self.inverted = code == 0x21

    def act(self, code, args):
        if code in (0x2a, 0x2b):
            swap = self.madctl >> 5 & 1
            at = 0 if code == 0x2a else 2
            self.set_window(at, *struct.unpack(">HH", args),
                            (self.columns, self.rows)[(at // 2) ^ swap])
        elif code == 0x36:
            self.madctl = args[0]
        elif code == 0x3a:
            self.depth = args[0]

    def store(self, content):
        count = len(content) // 2
        self.left_over = content[2 * count:]
        self.pixels += count
        words = struct.unpack(f">{count}H", content[:2 * count])
        if (self.madctl ^ self.upright) & 0x08:
            words = [w >> 11 | w & 0x07e0 | (w & 31) << 11 for w in words]
        for x, y, at, n in self.runs(count):
            self.store_run(x, y, words[at:at + n])

    def store_run(self, x, y, words):
        """Where MADCTL puts a row: 80 turns rows round, 40 columns, 20 exchanges both."""
        flips = self.madctl ^ self.upright
        if not self.madctl & 0x20:
            row = self.rows - 1 - y if flips & 0x80 else y
            step = -1 if flips & 0x40 else 1
            start = row * self.columns + (self.columns - 1 - x if step < 0 else x)
        else:
            column = self.columns - 1 - y if flips & 0x40 else y
            step = -self.columns if flips & 0x80 else self.columns
            start = (self.rows - 1 - x if step < 0 else x) * self.columns + column
        if step == 1:
            self.memory[start:start + len(words)] = words
        else:
            for word in words:
                self.memory[start] = word
                start += step


class Ili9341(Mipi):
    upright = 0x48
    parameters = Mipi.parameters | {
        0x26: 1, 0x33: 6, 0x37: 2, 0x51: 1, 0x53: 1, 0xb0: 1, 0xb1: 2, 0xb4: 1, 0xb5: 4, 0xb6: 3,
        0xb7: 1, 0xc0: 1, 0xc1: 1, 0xc5: 2, 0xc7: 1, 0xe0: 15, 0xe1: 15, 0xf6: 3}


class St7735(Mipi):
    upright = 0xc0
    reset_us = 120000
    wake = (0x11, 120000)
    parameters = Mipi.parameters | {
        0x26: 1, 0xb1: 3, 0xb2: 3, 0xb3: 6, 0xb4: 1, 0xb6: 2, 0xc0: 3, 0xc1: 1, 0xc2: 2, 0xc3: 2,
        0xc4: 2, 0xc5: 1, 0xe0: 16, 0xe1: 16, 0xfc: 1}


class St7789(Mipi):
    upright = 0x00
    parameters = Mipi.parameters | {
        0xb0: 2, 0xb2: 5, 0xb7: 1, 0xbb: 1, 0xc0: 1, 0xc2: 1, 0xc3: 1, 0xc4: 1, 0xc5: 1, 0xc6: 1,
        0xd0: 2, 0xe0: 14, 0xe1: 14}


class Ssd1351(Controller):
    """16-bit colour: columns by 15, rows by 75, pixels by 5C."""

    parameters = {0x15: 2, 0x5c: 0, 0x75: 2, 0xa0: 1, 0xa1: 1, 0xa2: 1, 0xa4: 0, 0xa5: 0, 0xa6: 0,
                  0xa7: 0, 0xab: 1, 0xad: 0, 0xae: 0, 0xaf: 0, 0xb0: 0, 0xb1: 1, 0xb2: 3, 0xb3: 1,
                  0xb4: 3, 0xb5: 1, 0xb6: 1, 0xb8: 63, 0xb9: 0, 0xbb: 1, 0xbe: 1, 0xc1: 3, 0xc7: 1,
                  0xca: 1, 0xd1: 0, 0xe3: 0, 0xfd: 1}
    reset_us = 2
    pixel_bytes = 2
    lines_code = 0xca

    def power_on(self, time_us):
        super().power_on(time_us)
        self.remap, self.lines, self.locked = 0, self.rows, True

    def writes(self):
        return self.code == 0x5c

    def begin(self, code, time_us):
        if code in (0xae, 0xaf):
            self.on = code == 0xaf
        elif code in (0xa4, 0xa5, 0xa6, 0xa7):
            self.inverted = code == 0xa7
        elif code == 0x5c:
            self.x, self.y = self.window[0], self.window[2]

    def act(self, code, args):
        if code == 0x15:
            self.set_window(0, args[0], args[1], self.columns)
        elif code == 0x75:
            self.set_window(2, args[0], args[1], self.rows)
        elif code == 0xa0:
            self.remap = args[0]
            if args[0] & 0xc0 != 0x40:
                self.fault(f"remap {args[0]:02x}: not 65536 colours")
        elif code == self.lines_code:
            self.lines = args[0] + 1

    def store(self, content):
        count = len(content) // 2
        self.left_over = content[2 * count:]
        self.pixels += count
        words = struct.unpack(f">{count}H", content[:2 * count])
        if not self.remap & 0x04:                           # the usual module has BGR
            words = [w >> 11 | w & 0x07e0 | (w & 31) << 11 for w in words]
        for i, word in enumerate(words):
            column = self.columns - 1 - self.x if self.remap & 0x02 else self.x
            self.memory[self.y * self.columns + column] = word
            self.step()

    def step(self):
        left, right, top, bottom = self.window
        if self.remap & 0x01:                               # down first
            self.y += 1
            if self.y > bottom:
                self.y, self.x = top, left if self.x == right else self.x + 1
        else:
            self.x += 1
            if self.x > right:
                self.x, self.y = left, top if self.y == bottom else self.y + 1

    def upside_down(self):
        return not self.remap & 0x10

    def glass(self):
        """The scan's direction counts when the picture is looked at, not when it is written."""
        out = super().glass()
        if self.upside_down():
            rows = [out[i:i + self.width] for i in range(0, len(out), self.width)]
            out = [p for row in reversed(rows) for p in row]
        return out


class Ssd1322(Ssd1351):
    """16 greys; a column address is 4 pixels in 2 bytes, the left one in the upper half."""

    parameters = {0x00: 0, 0x01: 0, 0x15: 2, 0x5c: 0, 0x75: 2, 0xa0: 2, 0xa1: 1, 0xa2: 1, 0xa4: 0,
                  0xa5: 0, 0xa6: 0, 0xa7: 0, 0xa8: 2, 0xa9: 0, 0xab: 1, 0xae: 0, 0xaf: 0, 0xb1: 1,
                  0xb3: 1, 0xb4: 2, 0xb5: 1, 0xb6: 1, 0xb8: 15, 0xb9: 0, 0xbb: 1, 0xbe: 1,
                  0xc1: 1, 0xc7: 1, 0xca: 1, 0xd1: 2, 0xfd: 1}
    reset_us = 100
    per_address = 4

    def act(self, code, args):
        if code == 0x15:
            self.set_window(0, args[0], args[1], self.columns // self.per_address)
        elif code == 0xa0:
            self.remap = args[0]
            if args[0] & 0x05 != 0x04:
                self.fault(f"remap {args[0]:02x}: the order of pixels in a word")
        else:
            super().act(code, args)

    def store(self, content):
        size = self.per_address // 2
        count = len(content) // size
        self.left_over = content[count * size:]
        self.pixels += count * self.per_address
        for i in range(count):
            greys = [n for b in content[i * size:(i + 1) * size] for n in (b >> 4, b & 15)]
            at = self.x * self.per_address
            if self.remap & 0x02:
                at = self.columns - self.per_address - at
                greys.reverse()
            at += self.y * self.columns
            self.memory[at:at + self.per_address] = greys
            self.step()

    def step(self):
        left, right, top, bottom = self.window
        self.x += 1
        if self.x > right:
            self.x, self.y = left, top if self.y == bottom else self.y + 1


class Ssd1329(Ssd1322):
    """16 greys; a column address is 2 pixels in a byte; parameters with D/C low."""

    parameters = {0x15: 2, 0x75: 2, 0x81: 1, 0x84: 0, 0x85: 0, 0x86: 0, 0xa0: 1, 0xa1: 1, 0xa2: 1,
                  0xa4: 0, 0xa5: 0, 0xa6: 0, 0xa7: 0, 0xa8: 1, 0xad: 1, 0xae: 0, 0xaf: 0, 0xb0: 1,
                  0xb1: 1, 0xb2: 1, 0xb3: 1, 0xb4: 1, 0xb7: 0, 0xb8: 15, 0xbc: 1, 0xbe: 1, 0xbf: 1,
                  0xe3: 0, 0xfd: 1}
    as_commands = True
    per_address = 2
    lines_code = 0xa8

    def writes(self):
        return self.code is None

    def act(self, code, args):
        if code == 0xa0:
            self.remap = args[0]
            if args[0] & 0x06 not in (0x02, 0x00) or (args[0] & 3) not in (1, 2):
                self.fault(f"remap {args[0]:02x}: the order of pixels in a byte")
        else:
            super().act(code, args)

    def store(self, content):
        self.pixels += 2 * len(content)
        for byte in content:
            greys = [byte >> 4, byte & 15]
            at = 2 * self.x
            if self.remap & 0x01:
                at = self.columns - 2 - at
                greys.reverse()
            at += self.y * self.columns
            self.memory[at:at + 2] = greys
            self.step()


class Ssd1306(Controller):
    """One bit a pixel: a byte is 8 lines of a column, the top one in bit 0."""

    parameters = {0x20: 1, 0x21: 2, 0x22: 2, 0x26: 6, 0x2e: 0, 0x81: 1, 0x8d: 1, 0xa0: 0, 0xa1: 0,
                  0xa4: 0, 0xa5: 0, 0xa6: 0, 0xa7: 0, 0xa8: 1, 0xae: 0, 0xaf: 0, 0xc0: 0, 0xc8: 0,
                  0xd3: 1, 0xd5: 1, 0xd9: 1, 0xda: 1, 0xdb: 1, 0xe3: 0} | \
        {code: 0 for code in range(0x40, 0x80)}
    as_commands = True
    reset_us = 3

    def power_on(self, time_us):
        super().power_on(time_us)
        self.window = [0, self.columns - 1, 0, self.rows // 8 - 1]
        self.mode, self.mirrored, self.upside_down = 2, True, True

    def writes(self):
        return self.code is None

    def begin(self, code, time_us):
        if code in (0xa0, 0xa1):
            self.mirrored = code == 0xa0                    # the usual module wants A1
        elif code in (0xc0, 0xc8):
            self.upside_down = code == 0xc0                 # and C8
        elif code in (0xae, 0xaf):
            self.on = code == 0xaf
        elif code in (0xa6, 0xa7):
            self.inverted = code == 0xa7

    def act(self, code, args):
        if code == 0x20:
            self.mode = args[0]
        elif code == 0x21:
            self.set_window(0, args[0], args[1], self.columns)
        elif code == 0x22:
            self.set_window(2, args[0], args[1], self.rows // 8)

    def store(self, content):
        left, right, top, bottom = self.window
        self.pixels += 8 * len(content)
        if self.mode > 1:
            self.fault("data in page mode")
        for byte in content:
            column = self.columns - 1 - self.x if self.mirrored else self.x
            for bit in range(8):
                self.memory[(8 * self.y + bit) * self.columns + column] = byte >> bit & 1
            if self.mode == 1:
                self.y += 1
                if self.y > bottom:
                    self.y, self.x = top, left if self.x == right else self.x + 1
            else:
                self.x += 1
                if self.x > right:
                    self.x, self.y = left, top if self.y == bottom else self.y + 1

    def glass(self):
        out = super().glass()
        if self.upside_down:
            rows = [out[i:i + self.width] for i in range(0, len(out), self.width)]
            out = [p for row in reversed(rows) for p in row]
        return out
