# SPDX-License-Identifier: 0BSD
"""The SPI panel at the guest's pins: the analyser's records, and controllers that obey them.

A controller keeps its memory as a person sees it on the glass (before any turning by hand): rows
of pixels, each a number. It notes what a real one would not forgive in `faults`.
"""

import os
import struct
import subprocess
import threading
import time

TROUBLE = {1: "D/C moved inside a byte", 2: "clock without chip select", 3: "part of a byte"}


class Controller:
    """What all have in common. Subclasses take whole bytes with their D/C level."""

    reset_us = 10            # RESET's shortest pulse
    settle_us = 5000         # after RESET, before the first command

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.memory = [0] * (width * height)
        self.faults = []
        self.log = []         # (code, parameters), pixels left out
        self.resets = 0
        self.pixels = 0       # how many were written
        self.low_since = self.reset_at = None
        self.change = 0

    def fault(self, text):
        if len(self.faults) < 20:
            self.faults.append(text)

    def reset_pin(self, level, time_us):
        if not level:
            self.low_since = time_us
        elif self.low_since is not None:
            self.resets += 1
            self.reset_at = time_us
            self.power_on()

    def power_on(self):
        raise NotImplementedError

    def data(self, dc, content, time_us):
        raise NotImplementedError


class Mipi(Controller):
    """ILI9341, ST7789, ST7735: windows by 2A and 2B, pixels by 2C, 16 bits each, high byte first."""

    parameters = {0x01: 0, 0x11: 0, 0x13: 0, 0x20: 0, 0x21: 0, 0x28: 0, 0x29: 0, 0x2a: 4, 0x2b: 4,
                  0x36: 1, 0x3a: 1}

    def __init__(self, width, height, columns, rows, offset=(0, 0)):
        """Visible width and height in the memory of columns x rows, from the offset on."""
        super().__init__(width, height)
        self.columns, self.rows, self.offset = columns, rows, offset
        self.memory = [0] * (columns * rows)
        self.power_on()

    def power_on(self):
        self.code, self.args, self.madctl, self.depth = None, bytearray(), 0, None
        self.awake = self.on = self.inverted = False
        self.window = [0, self.columns - 1, 0, self.rows - 1]
        self.x = self.y = 0
        self.half = b""

    def data(self, dc, content, time_us):
        if dc:
            self.take(content)
            return
        for code in content:
            self.finish()
            self.code, self.args, self.half = code, bytearray(), b""
            if code == 0x2c:
                self.x, self.y = self.window[0], self.window[2]
                if self.depth not in (0x05, 0x55):
                    self.fault(f"pixels with depth {self.depth}")
            elif code == 0x01:
                self.power_on()
            elif code == 0x11:
                self.awake = True
            elif code == 0x29:
                self.on = True
            elif code in (0x20, 0x21):
                self.inverted = code == 0x21

    def finish(self):
        """The command before ended."""
        if self.code is None:
            return
        self.log.append((self.code, bytes(self.args)))
        wanted = self.parameters.get(self.code)
        if wanted is not None and len(self.args) != wanted:
            self.fault(f"command {self.code:02x} with {len(self.args)} parameters")
        if self.half:
            self.fault("half a pixel")
        self.code = None

    def take(self, content):
        if self.code is None:
            self.fault("data without a command")
        elif self.code in (0x2c, 0x3c):
            self.store(self.half + content)
        else:
            self.args += content
            if self.code in (0x2a, 0x2b) and len(self.args) == 4:
                first, last = struct.unpack(">HH", self.args)
                at = 0 if self.code == 0x2a else 2
                limit = (self.columns, self.rows)[(at // 2) ^ (self.madctl >> 5 & 1)]
                if first > last or last >= limit:
                    self.fault(f"window {first}..{last} of {limit}")
                    return
                self.window[at:at + 2] = first, last
            elif self.code == 0x36:
                self.madctl = self.args[0]
            elif self.code == 0x3a:
                self.depth = self.args[0]

    def store(self, content):
        left, right, top, bottom = self.window
        count = len(content) // 2
        self.half = content[2 * count:]
        self.pixels += count
        words = struct.unpack(f">{count}H", content[:2 * count])
        at = 0
        while at < count:
            n = min(count - at, right - self.x + 1)
            self.store_run(words[at:at + n])
            at += n
            self.x += n
            if self.x > right:
                self.x = left
                self.y = top if self.y == bottom else self.y + 1

    def store_run(self, words):
        """Pixels of one row of the window, where MADCTL puts them: MY 80, MX 40, MV 20."""
        x, y = self.x, self.y
        if not self.madctl & 0x20:
            row = self.rows - 1 - y if self.madctl & 0x80 else y
            step = -1 if self.madctl & 0x40 else 1
            start = row * self.columns + (self.columns - 1 - x if step < 0 else x)
        else:
            column = self.columns - 1 - y if self.madctl & 0x40 else y
            step = -self.columns if self.madctl & 0x80 else self.columns
            start = (self.rows - 1 - x if step < 0 else x) * self.columns + column
        if step == 1:
            self.memory[start:start + len(words)] = words
        else:
            for word in words:
                self.memory[start] = word
                start += step

    def glass(self):
        """The visible pixels, rows from the top: 16 bits each, as they were sent."""
        left, top = self.offset
        out = []
        for row in range(top, top + self.height):
            at = row * self.columns + left
            out += self.memory[at:at + self.width]
        return out


class Bus:
    """The analyser at work: `trace` is where QEMU writes; `panel` obeys what comes."""

    def __init__(self, folder, analyser, dc=4, reset=5, vcd=None):
        os.makedirs(folder, exist_ok=True)
        self.trace = os.path.join(folder, "pins")
        if os.path.exists(self.trace):
            os.unlink(self.trace)
        os.mkfifo(self.trace)
        # Opened for both, so that neither side waits for the other.
        self.pipe = os.open(self.trace, os.O_RDWR)
        command = [analyser, "--dc", str(dc)] + (["--vcd", vcd] if vcd else [])
        self.process = subprocess.Popen(command, stdin=os.open(self.trace, os.O_RDONLY),
                                        stdout=subprocess.PIPE)
        self.reset = reset
        self.panel = None
        self.faults = []
        self.bytes = [0, 0]
        self.sent = bytearray()        # all bytes, when `keep` is set
        self.keep = False
        self.levels = {}
        self.watch = None              # called after each transaction
        self.last = time.monotonic()
        self.thread = threading.Thread(target=self._read, daemon=True)
        self.thread.start()

    def _read(self):
        out = self.process.stdout
        while True:
            head = out.read(16)
            if len(head) < 16:
                return
            kind, detail, length, time_us = struct.unpack("<cBxxIQ", head)
            content = out.read(length) if length else b""
            self._take(kind, detail, content, time_us)
            self.last = time.monotonic()

    def _take(self, kind, detail, content, time_us):
        if kind == b"D":
            self.bytes[detail] += len(content)
            if self.keep:
                self.sent += content
            if self.panel:
                self.panel.data(detail, content, time_us)
        elif kind == b"P":
            line, level = detail >> 1, detail & 1
            self.levels[line] = level
            if line == self.reset and self.panel:
                self.panel.reset_pin(level, time_us)
        elif kind == b"X":
            self.faults.append(TROUBLE[detail])
        elif kind == b"E" and self.watch:
            self.watch()

    def attach(self, panel):
        """From here on this panel is connected, and the counters start anew."""
        self.settle()
        self.panel = panel
        if not self.levels.get(self.reset):
            panel.reset_pin(0, time.monotonic_ns() // 1000)
        self.faults = []
        self.bytes = [0, 0]
        self.sent = bytearray()
        return panel

    def settle(self):
        """Waits until all that the guest has done has come through."""
        self.last = time.monotonic()
        while time.monotonic() - self.last < 0.1:
            time.sleep(0.02)

    def close(self):
        """Ends the analyser, once QEMU is gone."""
        os.close(self.pipe)
        self.process.terminate()
        self.process.wait()
