# SPDX-License-Identifier: 0BSD
"""Proves the instruments: what vmtool writes to each device is what the tests see there."""

import os
import shutil
import struct
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from bus import Bus
from check import OUT, rows_565, rows_888, run, swapped, to_565
from controllers import Mipi
from guest import Guest


def pattern(width, height):
    return [(x * 31 // width) << 11 | (y * 63 // height) << 5 | ((x ^ y) & 31)
            for y in range(height) for x in range(width)]


def spi(report, guest, bus):
    draw = "vmtool spi /dev/spidev0.0 /dev/gpiochip0 {} 5 32 16"
    panel = bus.attach(Mipi(32, 16, 32, 16))
    bus.keep = True
    guest.must(draw.format(4))
    bus.settle()
    report.pictures("spi", "vmtool: SPI on the PL061", [panel.glass()], [pattern(32, 16)])
    report.equal("spi: nothing to complain of", (panel.faults, bus.faults), ([], []))
    report.control("spi: bytes swapped are seen", "vmtool: SPI, bytes swapped", panel.glass(),
                   swapped(pattern(32, 16)))
    sent = bytes(bus.sent)

    panel = bus.attach(Mipi(32, 16, 32, 16))
    guest.must(draw.format(6))
    bus.settle()
    report.control("spi: D/C on a wrong line is seen", "vmtool: SPI, D/C on line 6",
                   panel.glass(), pattern(32, 16))
    return sent


def sigrok(report, vcd, sent):
    """A second decoder: the bytes of the first drawing, by sigrok."""
    if shutil.which("sigrok-cli") is None:
        print("skip sigrok: sigrok-cli is not installed")
        return
    found = subprocess.run(["sigrok-cli", "-i", vcd, "-I", "vcd", "-P",
                            "spi:clk=SCK:mosi=MOSI:cs=CS", "-B", "spi=mosi"], check=True,
                           capture_output=True).stdout
    report.check("spi: sigrok decodes the same bytes", found[:len(sent)] == sent,
                 f"{len(found)} bytes")


def fb(report, guest):
    for device, address, size, depth in ((0, 0x5f000000, (320, 240, 672), 16),
                                         (1, 0x5f100000, (480, 320, 1920), 32)):
        width, height, stride = size
        report.equal(f"fb{device}: its size", guest.must(f"vmtool size /dev/fb{device}").split()[:4],
                     [str(n) for n in (width, height, depth, stride)])
        guest.must(f"vmtool fb /dev/fb{device}")
        memory = guest.memory(address, stride * height)
        wanted = pattern(width, height)
        if depth == 16:
            got = rows_565(memory, *size)
        else:
            got = to_565(rows_888(memory, *size))
        report.pictures(f"fb{device}", f"vmtool: fbdev, {depth} bits", [got], [wanted])


def video(report, guest):
    frame = b"".join(struct.pack("<H", w) for w in pattern(320, 240))
    with open(os.path.join(guest.share, "frame"), "wb") as file:
        file.write(frame)
    guest.must("vmtool loop /dev/video1 /dev/video0 320 240 RGBP")
    feed = guest.start("vmtool feed /dev/video1 /host/frame")
    feed.wait_for("feeding")
    guest.must("vmtool capture /dev/video0 10 /host/captured")
    feed.kill("KILL")
    with open(os.path.join(guest.share, "captured"), "rb") as file:
        data = file.read()[-len(frame):]
    report.pictures("video", "vmtool: V4L2 out to in, RGB565",
                    [list(struct.unpack(f"<{len(data) // 2}H", data))], [pattern(320, 240)])


def body(report):
    vcd = os.path.join(OUT, "kernel.vcd")
    bus = Bus(os.path.join(OUT, "kernel-bus"), f"{OUT}/analyser", vcd=vcd)
    with Guest("kernel", ["spi-gpio", "spidev", "vivid"],
               "vivid.n_devs=1 vivid.node_types=0x101", trace=bus.trace, out=OUT) as guest:
        guest.install(f"{OUT}/vmtool")
        sent = spi(report, guest, bus)
        fb(report, guest)
        video(report, guest)
    bus.close()
    sigrok(report, vcd, sent)


run("kernel", body)
