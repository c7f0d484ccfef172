# SPDX-License-Identifier: 0BSD
"""oldwell on panels with a controller: every pixel that arrives over SPI, D/C and RESET."""

import os
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from bus import Bus
from check import OUT, orbit, owt, run, soon, swapped, to_565
from controllers import Ili9341, Ssd1306, Ssd1322, Ssd1329, Ssd1351, St7735, St7789
from guest import Guest
from heap import Heap

VIEWS = 8
SPI = "/dev/spidev0.0"
LINES = "--dc DC --reset RESET"


def to_gray4(pixels):
    return [(p & 255) >> 4 for p in pixels]


def to_mono(pixels):
    return [p & 1 for p in pixels]


def frames(width, height, form, views=VIEWS, tree=None):
    read = {"rgb565": to_565, "gray4": to_gray4, "mono": to_mono}[form]
    return [read(f) for f in orbit(views, width, height, "--format", form, tree=tree)]


def turned(picture, width, quarters):
    """The picture turned clockwise, as rows one after the other."""
    rows = [picture[i:i + width] for i in range(0, len(picture), width)]
    for _ in range(quarters):
        rows = [list(row) for row in zip(*rows[::-1])]
    return [p for row in rows for p in row]


class Panel:
    """A panel at the pins, and how oldwell is told of it."""

    def __init__(self, name, controller, size, options="", **more):
        self.name, self.controller, self.options = name, controller, options
        self.width, self.height = size
        self.more = more

    def attach(self, bus):
        columns, rows = self.more.get("memory", (self.width, self.height))
        return bus.attach(self.controller(self.width, self.height, columns, rows,
                                          offset=self.more.get("offset", (0, 0))))

    def command(self, program="oldwell", lines=LINES):
        return f"{program} --panel {self.name} --device {SPI} {lines} {self.options}"


ST7735 = Panel("st7735", St7735, (128, 128), "--size 128x128 --offset 2,1", memory=(132, 162),
               offset=(2, 1))
ST7789_SMALL = Panel("st7789", St7789, (135, 240), "--size 135x240 --offset 52,40 --rotate 270",
                     memory=(240, 320), offset=(52, 40))
ILI9341 = Panel("ili9341", Ili9341, (240, 320), "--rotate 90")
SSD1306 = Panel("ssd1306", Ssd1306, (128, 64))
SSD1351 = Panel("ssd1351", Ssd1351, (128, 128))
SSD1322 = Panel("ssd1322", Ssd1322, (256, 64), memory=(480, 128), offset=(112, 0))
SSD1329 = Panel("ssd1329", Ssd1329, (128, 128))


def once(report, guest, bus, panel, view=0, **how):
    """Draws one view; what the panel shows then. It must have had nothing to complain of."""
    model = panel.attach(bus)
    status, said = guest.sh(f"{panel.command(**how)} --once --orbit {VIEWS} --first {view}"
                            " --retry 0 /host/oldwell.owt 2>&1", 120)
    bus.settle()
    report.equal(f"{panel.name}: view {view} is sent without a fault",
                 (status, said, model.faults, bus.faults, model.resets, model.on),
                 (0, "", [], [], 1, True))
    return model.glass()


def small(report, guest, bus):
    """128x128, three frames, the lines by name, by number, by the chip's label; both libraries."""
    wanted = frames(128, 128, "rgb565")
    views = (0, 3, 6)
    how = ({"program": "oldwell1"}, {"lines": "--dc gpiochip0:4 --reset gpiochip0:5"},
           {"program": "oldwell1", "lines": "--dc 9030000.pl061:DC --reset 9030000.pl061:5"})
    got = [once(report, guest, bus, ST7735, v, **h) for v, h in zip(views, how)]
    report.pictures("st7735", "SPI 128x128 ST7735, libgpiod 1 and 2", got,
                    [wanted[v] for v in views])
    report.control("spi: bytes swapped are seen", "SPI 128x128, bytes swapped", swapped(got[0]),
                   wanted[0])
    model = ST7735.attach(bus)
    guest.must(f"{ST7735.command(lines='--dc ENC_A --reset RESET')} --once --orbit {VIEWS}"
               " /host/oldwell.owt", 60)
    bus.settle()
    report.control("spi: D/C on a wrong line is seen", "SPI 128x128, D/C on a wrong line",
                   model.glass(), wanted[0])


def others(report, guest, bus):
    for panel, form, quarters in ((SSD1306, "mono", 0), (SSD1351, "rgb565", 0),
                                  (SSD1322, "gray4", 0), (SSD1329, "gray4", 0),
                                  (ST7789_SMALL, "rgb565", 3)):
        width, height = panel.width, panel.height
        if quarters % 2:
            width, height = height, width
        picture = turned(frames(width, height, form)[0], width, quarters)
        report.pictures(f"{panel.name} {panel.width}x{panel.height}",
                        f"SPI {panel.width}x{panel.height} {panel.name.upper()} {form}"
                        + (f", turned {90 * quarters}" if quarters else ""),
                        [once(report, guest, bus, panel)], [picture])


def large(report, guest, bus):
    """320x240: a whole frame, then only what changes when another tree comes, and back."""
    well = turned(frames(320, 240, "rgb565", 1)[0], 320, 1)
    cubes = turned(frames(320, 240, "rgb565", 1, owt("cubes"))[0], 320, 1)
    guest.must("cp /host/oldwell.owt /tmp/shown.owt")
    model = ILI9341.attach(bus)
    program = guest.start(f"{ILI9341.command()} --still --stats /tmp/shown.owt")
    got, sent = [], []
    for wanted, tree in ((well, None), (cubes, "cubes"), (well, "oldwell")):
        before = sum(bus.bytes)
        if tree:
            guest.must(f"cp /host/{tree}.owt /tmp/new && mv /tmp/new /tmp/shown.owt")
        soon(model.glass, wanted, 90)
        bus.settle()
        got.append(model.glass())
        sent.append(sum(bus.bytes) - before)
    report.pictures("ili9341", "SPI 320x240 ILI9341, then what changed", got, [well, cubes, well])
    print("bytes on the bus:", *sent)
    report.check("ili9341: a change costs less than a frame",
                 sent[0] >= 153600 and 1000 < sent[1] < 100000 and 1000 < sent[2] < 100000, sent)
    program.kill()
    report.equal("ili9341: it ends well and dark", (program.wait(), model.on, model.awake,
                                                     model.faults, bus.faults),
                 (0, False, False, [], []))


def moving(report, guest, bus):
    """A turning model: the panel goes from whole frame to whole frame, and ends with one."""
    wanted = frames(128, 128, "gray4", 64)
    model = SSD1329.attach(bus)
    seen = []

    def watch():
        now = model.glass()
        if now in wanted and wanted.index(now) not in seen[-1:]:
            seen.append(wanted.index(now))

    guest.must("cp /host/bin/oldwell /tmp")
    heap = Heap(guest, f"{OUT}/gpiod2/oldwell", "/tmp/oldwell")
    bus.watch = watch
    program = guest.start(f"{SSD1329.command('/tmp/oldwell')} --orbit 64 /host/oldwell.owt")
    soon(lambda: len(seen) >= 2, True)
    before = heap.calls()
    soon(lambda: len(seen) >= 6, True)
    report.check("spi: no call of the heap while it draws",
                 heap.calls() == before and before["malloc"] > 0, (before, heap.calls()))
    program.kill()
    status = program.wait()
    heap.close()
    bus.settle()
    bus.watch = None
    steps = [(b - a) % 64 for a, b in zip(seen, seen[1:])]
    report.check("spi: a turn goes frame by frame", len(seen) >= 6 and all(0 < s < 8 for s in steps),
                 seen)
    report.equal("spi: stopped in mid-turn, it ends with a whole frame",
                 (status, model.glass() in wanted, model.faults, bus.faults), (0, True, [], []))


def killed(report, guest, bus):
    """SIGKILL in the middle of a frame; the next program finds its way."""
    ST7735.attach(bus)
    program = guest.start(f"{ST7735.command()} --still /host/oldwell.owt")
    soon(lambda: bus.bytes[1] > 8000, True)
    program.kill("KILL")
    program.wait()
    got = once(report, guest, bus, ST7735)
    report.check("spi: after SIGKILL in mid-frame the next one draws",
                 got == frames(128, 128, "rgb565")[0], "the frame is wrong")


def faults(report, guest):
    holder = guest.start("vmtool hold /dev/gpiochip0 7")
    holder.wait_for("held")
    base = "oldwell --panel st7735 --once --retry 0 /host/oldwell.owt"
    for name, command, status, words in (
            ("no such bus", f"{base} --device /dev/spidev9.0 {LINES}", 3, "/dev/spidev9.0"),
            ("no such line", f"{base} --device {SPI} --dc NOPE --reset RESET", 3, "NOPE"),
            ("no such chip", f"{base} --device {SPI} --dc gpiochip7:4", 3, "gpiochip7"),
            ("a line beyond the chip", f"{base} --device {SPI} --dc gpiochip0:99", 3, "99"),
            ("a busy line", f"{base} --device {SPI} --dc ENC_B --reset RESET", 3, "vmtool"),
            ("not a bus", f"{base} --device /dev/null {LINES}", 5, "/dev/null"),
            ("no D/C", f"{base} --device {SPI} --reset RESET", 2, "--dc"),
            ("no permission", f"vmtool as 1000 {base} --device {SPI} {LINES}", 4, "")):
        for program in ("oldwell", "oldwell1"):
            got, said = guest.sh(command.replace("oldwell --panel", f"{program} --panel") + " 2>&1")
            report.check(f"spi: {name} ({program})", got == status and words in said and
                         (status == 2 or "\n" not in said), f"status {got}: {said}")
    holder.kill("KILL")
    holder.wait()


def unplugged(report, guest, bus):
    driver = "/sys/bus/spi/drivers/spidev"
    wanted = frames(128, 128, "gray4", 64)
    model = SSD1329.attach(bus)
    program = guest.start(f"{SSD1329.command()} --orbit 64 --retry 30 /host/oldwell.owt")
    soon(lambda: model.glass() in wanted, True)
    guest.must(f"echo spi0.0 >{driver}/unbind")
    program.wait_for(SPI)
    guest.must(f"echo spi0.0 >{driver}/bind")
    before = model.resets
    soon(lambda: model.resets > before, True)
    back = soon(lambda: model.glass() in wanted, True)
    report.check("spi: it goes on when the bus comes back", back and program.alive(),
                 program.errors())
    guest.must(f"echo spi0.0 >{driver}/unbind")
    time.sleep(0.2)
    program.kill()
    report.equal("spi: and can be ended without it", program.wait(), 0)
    status, said = guest.sh(f"{SSD1329.command()} --once --retry 1 /host/oldwell.owt 2>&1")
    report.check("spi: the bus is gone", status == 3 and SPI in said, f"status {status}: {said}")
    guest.must(f"echo spi0.0 >{driver}/bind")


def sigrok(report, vcd, sent):
    """The second decoder: the first bytes of all this, by sigrok."""
    if shutil.which("sigrok-cli") is None:
        print("skip spi: sigrok-cli is not installed")
        return
    found = subprocess.run(["sigrok-cli", "-i", vcd, "-I", "vcd", "-P",
                            "spi:clk=SCK:mosi=MOSI:cs=CS", "-B", "spi=mosi"], check=True,
                           capture_output=True).stdout
    report.check("spi: sigrok decodes the same bytes",
                 len(sent) > 1000 and found[:len(sent)] == sent, f"{len(found)} bytes")


def body(report):
    vcd = os.path.join(OUT, "spi.vcd")
    bus = Bus(os.path.join(OUT, "spi-bus"), f"{OUT}/analyser", vcd=vcd)
    with Guest("spi", ["spi-gpio", "spidev"], trace=bus.trace, out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        shutil.copy(f"{OUT}/gpiod1/oldwell", os.path.join(guest.share, "bin/oldwell1"))
        os.link(owt(), os.path.join(guest.share, "oldwell.owt"))
        os.link(owt("cubes"), os.path.join(guest.share, "cubes.owt"))
        bus.keep = True
        once(report, guest, bus, SSD1306, program="oldwell1")
        sent = bytes(bus.sent)
        bus.keep = False
        small(report, guest, bus)
        others(report, guest, bus)
        large(report, guest, bus)
        moving(report, guest, bus)
        killed(report, guest, bus)
        unplugged(report, guest, bus)
        faults(report, guest)
    bus.close()
    sigrok(report, vcd, sent)


run("spi", body)
