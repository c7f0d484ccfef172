# SPDX-License-Identifier: 0BSD
"""What the tests report: `ok NAME` and `not ok NAME`, and the table of pictures compared."""

import os
import struct
import subprocess
import sys
import time
import traceback

O = os.environ.get("O", "build")
OUT = os.path.join(O, "vm")


class Report:
    def __init__(self, name):
        self.name = name
        self.failed = 0
        self.count = 0
        os.makedirs(os.path.join(OUT, "table"), exist_ok=True)
        self.table = os.path.join(OUT, "table", name)
        with open(self.table, "w", encoding="utf-8"):
            pass

    def check(self, name, good, why=""):
        """One test; `why` is printed when it failed."""
        self.count += 1
        self.failed += not good
        print(f"ok {name}" if good else f"not ok {name}: {str(why)[:1500]}", flush=True)
        return good

    def equal(self, name, got, wanted):
        return self.check(name, got == wanted, f"got {got!r}, should be {wanted!r}")

    def pictures(self, name, device, frames, wanted):
        """Compares frames pixel by pixel; each is a list of numbers. One row of the table."""
        differing = [sum(a != b for a, b in zip(f, w)) + abs(len(f) - len(w))
                     for f, w in zip(frames, wanted)]
        good = len(frames) == len(wanted) and not any(differing) and frames
        pixels = sum(map(len, wanted))
        with open(self.table, "a", encoding="utf-8") as file:
            file.write(f"{name}\t{device}\t{len(frames)}\t{pixels}\t{sum(differing)}\n")
        return self.check(name, good, f"{len(frames)} of {len(wanted)} frames, pixels that differ:"
                                      f" {differing}")

    def control(self, name, device, frame, wanted):
        """A negative control: the frame must not be what is wanted."""
        differing = sum(a != b for a, b in zip(frame, wanted))
        with open(self.table, "a", encoding="utf-8") as file:
            file.write(f"{name}\t{device} (must differ)\t1\t{len(wanted)}\t{differing}\n")
        return self.check(name, differing > 0, "it went unnoticed")


def run(name, body):
    """Runs body(report) as the program: exit status 1 if a test failed or it broke off."""
    report = Report(name)
    try:
        body(report)
    except Exception:                                   # what it is, the report says
        traceback.print_exc()
        report.check(f"{name} comes to its end", False, sys.exc_info()[1])
    if report.count == 0:
        report.check(name, False, "nothing was tested")
    sys.exit(report.failed > 0)


# ---- pictures to compare with -------------------------------------------------------------------
def read_ppms(data):
    """All pictures of a stream of PPMs: (width, height, [0xrrggbb])."""
    at = 0
    while at < len(data):
        fields = data[at:at + 60].split(maxsplit=4)
        width, height = int(fields[1]), int(fields[2])
        head = data.index(b"\n255\n", at) + 5
        at = head + 3 * width * height
        yield width, height, rgb(data[head:at])


def owsim(*arguments):
    """The frames that owsim draws with these arguments, as lists of 0xrrggbb."""
    out = subprocess.run([f"{O}/owsim", *map(str, arguments), "-o", "-"], check=True,
                         capture_output=True).stdout
    return [pixels for _, _, pixels in read_ppms(out)]


def to_565(pixels):
    """0xrrggbb to 16 bits: the upper bits of each colour."""
    return [p >> 8 & 0xf800 | p >> 5 & 0x07e0 | p >> 3 & 0x1f for p in pixels]


def swapped(words):
    """16-bit words with their bytes exchanged."""
    return [w >> 8 | (w & 255) << 8 for w in words]


def owt(*model):
    """A compiled tree, by owgen's arguments: the Old Well if there are none."""
    model = model or ("oldwell", "--detail", "high")
    path = os.path.join(OUT, "-".join(w.strip("-") for w in model) + ".owt")
    newer = max(os.path.getmtime(f"{O}/{p}") for p in ("owgen", "owc"))
    if not os.path.exists(path) or os.path.getmtime(path) < newer:
        subprocess.run([f"{O}/owgen", *model, "-o", f"{path}.obj"], check=True)
        subprocess.run([f"{O}/owc", f"{path}.obj", "-o", path], check=True, capture_output=True)
    return path


def orbit(views, width, height, *arguments, tree=None):
    """owsim's frames of a turn of so many views."""
    return owsim(tree or owt(), "--orbit", views, "--size", f"{width}x{height}", *arguments)


# ---- memory as pixels ---------------------------------------------------------------------------
def rows_565(memory, width, height, stride):
    """Rows of little-endian 16-bit pixels, `stride` bytes apart."""
    rows = (memory[y * stride:y * stride + 2 * width] for y in range(height))
    return [w for row in rows for w in struct.unpack(f"<{width}H", row)]


def rows_888(memory, width, height, stride):
    """Rows of little-endian 32-bit pixels, the spare byte left out."""
    rows = (memory[y * stride:y * stride + 4 * width] for y in range(height))
    return [w & 0xffffff for row in rows for w in struct.unpack(f"<{width}I", row)]


def rgb(data):
    """Bytes red, green, blue as 0xrrggbb."""
    return [data[i] << 16 | data[i + 1] << 8 | data[i + 2] for i in range(0, len(data), 3)]


def soon(look, wanted, seconds=30):
    """Looks again and again until what is wanted is there; what it saw last."""
    end = time.monotonic() + seconds
    while True:
        seen = look()
        if seen == wanted or time.monotonic() > end:
            return seen
        time.sleep(0.05)


def watch(look, pictures, seconds=30):
    """What is seen in 20 looks or more, until that many different pictures were there."""
    end = time.monotonic() + seconds
    seen = []
    while len(seen) < 20 or (len(set(seen)) < pictures and time.monotonic() < end):
        seen.append(tuple(look()))
    return seen
