# SPDX-License-Identifier: 0BSD
"""oldwell --panel fbdev: every pixel, the console, and devices that are not there."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from check import OUT, orbit, owt, rgb, rows_565, rows_888, run, soon, swapped, to_565, watch
from guest import Guest

VIEWS = 8
LOOKED_AT = (0, 3, 6)
FRAMES_565 = (0x5f000000, 320, 240, 672)
FRAMES_888 = (0x5f100000, 480, 320, 1920)


def show(guest, view, options):
    return guest.start(f"oldwell --panel fbdev {options} --orbit {VIEWS} --first {view} --still"
                       " /host/oldwell.owt")


def draw(guest, options, look, wanted):
    """What the device shows for some views of the turn."""
    seen = []
    for view in LOOKED_AT:
        program = show(guest, view, options)
        seen.append(soon(look, wanted[view]))
        program.kill()
        program.wait()
    return seen


def simple(report, guest):
    address, width, height, stride = FRAMES_565
    wanted = [to_565(f) for f in orbit(VIEWS, width, height, "--format", "rgb565")]
    got = draw(guest, "--device /dev/fb0",
               lambda: rows_565(guest.memory(address, stride * height), width, height, stride),
               wanted)
    report.pictures("fbdev RGB565", "fbdev 320x240 RGB565, rows of 672 bytes", got,
                    [wanted[v] for v in LOOKED_AT])
    report.control("fbdev: bytes swapped are seen", "fbdev 320x240 RGB565, bytes swapped", got[0],
                   swapped(wanted[0]))

    address, width, height, stride = FRAMES_888
    wanted = orbit(VIEWS, width, height)
    got = draw(guest, "--device /dev/fb1",
               lambda: rows_888(guest.memory(address, stride * height), width, height, stride),
               wanted)
    report.pictures("fbdev XRGB8888", "fbdev 480x320 XRGB8888", got,
                    [wanted[v] for v in LOOKED_AT])


def virtio(report, guest):
    wanted = orbit(VIEWS, 320, 240)
    for name, option in (("panning", ""), ("copying", "--one-page")):
        got = draw(guest, f"--device /dev/fb2 {option}", lambda: rgb(guest.screen()[2]), wanted)
        report.pictures(f"fbdev virtio-gpu, {name}", f"fbdev virtio-gpu 320x240, {name}", got,
                        [wanted[v] for v in LOOKED_AT])
    # Moving: whatever is on the screen is a whole frame.
    program = guest.start(f"oldwell --panel fbdev --device /dev/fb2 --orbit {VIEWS} --fps 10"
                          " /host/oldwell.owt")
    soon(lambda: rgb(guest.screen()[2]) in wanted, True)
    seen = watch(lambda: rgb(guest.screen()[2]), 3)
    torn = sum(list(picture) not in wanted for picture in seen)
    program.kill()
    report.equal("fbdev: SIGTERM ends it well", program.wait(), 0)
    report.check("fbdev: pages change whole", torn == 0,
                 f"{torn} of {len(seen)} were not whole")
    report.check("fbdev: it moves", len(set(seen)) > 2, f"{len(set(seen))} pictures")


def console(report, guest):
    """Graphics while it draws, text again whatever ends it: itself or the one that draws."""
    mode = "vmtool console"
    address, width, height, stride = FRAMES_565
    wanted = to_565(orbit(VIEWS, width, height, "--format", "rgb565")[0])

    def look():
        return rows_565(guest.memory(address, stride * height), width, height, stride)

    for signal, child in (("TERM", False), ("INT", False), ("SEGV", True), ("KILL", True),
                          ("KILL", False)):
        program = show(guest, 0, "--device /dev/fb0")
        during = soon(lambda: guest.must(mode), "graphics")
        if signal in ("TERM", "INT"):        # it looks after them once it draws
            soon(lambda: look() == wanted, True)
        program.kill(signal, program.child() if child else program.pid)
        status = program.wait()
        after = soon(lambda: guest.must(mode), "text", 5)
        left = soon(lambda: guest.sh("ps | grep -c '[o]ldwell --panel'")[1], "0", 5)
        report.equal(f"console: SIG{signal} {'to the drawing process' if child else ''}".rstrip(),
                     (during, after, left, status == 0),
                     ("graphics", "text", "0", signal in ("TERM", "INT")))


def faults(report, guest):
    for name, command, status, words in (
            ("no such device", "oldwell --device /dev/fb9 --once /host/oldwell.owt", 3, "/dev/fb9"),
            ("no permission",
             "vmtool as 1000 oldwell --console none --device /dev/fb0 --once /host/oldwell.owt", 4, "/dev/fb0"),
            ("not a frame buffer", "oldwell --device /dev/null --once /host/oldwell.owt", 5,
             "/dev/null"),
            ("no tree", "oldwell --device /dev/fb0 --once /host/none.owt", 1, "none.owt")):
        got, output = guest.sh(f"{command} --retry 0 2>&1")
        report.check(f"fbdev: {name}", got == status and words in output and
                     output.count("\n") == 0, f"status {got}: {output}")


def doctor(report, guest):
    """A pattern with a line all round, and words about what is wrong."""
    address, width, height, stride = FRAMES_565
    program = guest.start("oldwell doctor --device /dev/fb0")
    program.wait_for("ok panel", 20)

    def edge():
        p = rows_565(guest.memory(address, stride * height), width, height, stride)
        return set(p[:width] + p[-width:] + p[::width] + p[width - 1::width])

    report.equal("doctor: a white line all round", soon(edge, {0xffff}), {0xffff})
    program.kill()
    program.wait()
    said = program.output() + program.errors()
    report.check("doctor: the panel is right", f"{width}x{height}" in said and
                 "not ok" not in said, said)
    for name, command, status in (("no device", "oldwell doctor --device /dev/fb9", 3),
                                  ("no permission", "vmtool as 1000 oldwell doctor", 4)):
        got, said = guest.sh(f"{command} --console none 2>&1")
        report.check(f"doctor: {name}", got == status and "not ok" in said, f"status {got}: {said}")


def body(report):
    tree = owt()
    with Guest("fbdev", ["virtio-gpu"], "drm_kms_helper.drm_fbdev_overalloc=200",
               ["-device", "virtio-gpu-pci,xres=320,yres=240"], out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        os.link(tree, os.path.join(guest.share, "oldwell.owt"))
        simple(report, guest)
        virtio(report, guest)
        console(report, guest)
        faults(report, guest)
        doctor(report, guest)


run("fbdev", body)
