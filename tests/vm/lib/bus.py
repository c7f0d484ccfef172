# SPDX-License-Identifier: 0BSD
"""The guest's pins: the analyser's records, and the controller that they are wired to."""

import os
import struct
import subprocess
import threading
import time

TROUBLE = {1: "D/C moved inside a byte", 2: "clock without chip select", 3: "part of a byte"}


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
            panel.reset_pin(0, 0)
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
        os.close(self.pipe)            # the last writer: the analyser comes to the end
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
