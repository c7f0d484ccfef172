# SPDX-License-Identifier: 0BSD
"""oldwell and V4L2, by vivid: what goes out comes back in, and the camera behind the model.

vivid's output is joined to its capture by vmtool. The program on trial has one end, vmtool the
other.
"""

import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from check import OUT, orbit, owt, rows_565, run, soon, swapped, to_565
from guest import Guest

VIEWS = 8
LOOKED_AT = (0, 3, 6)
WIDTH, HEIGHT = 320, 240
IN, OUTPUT = "/dev/video0", "/dev/video1"
FRAME_BUFFER = (0x5f000000, WIDTH, HEIGHT, 672)


def luma(p):
    return (66 * (p >> 16) + 129 * (p >> 8 & 255) + 25 * (p & 255) + 128 >> 8) + 16


def chroma(pixels):
    """Cb and Cr of the mean of some pixels, BT.601 in limited range, rounded."""
    n = len(pixels)
    red, green, blue = (sum(p >> s & 255 for p in pixels) for s in (16, 8, 0))
    half = 128 * n
    return [(c + half) // (256 * n) + 128
            for c in (-38 * red - 74 * green + 112 * blue, 112 * red - 94 * green - 18 * blue)]


def to_yuyv(pixels):
    out = []
    for i in range(0, len(pixels), 2):
        left, right = pixels[i:i + 2]
        blue, red = chroma([left, right])
        out += [luma(left), blue, luma(right), red]
    return out


def to_nv12(pixels):
    out = [luma(p) for p in pixels]
    for y in range(0, HEIGHT, 2):
        for x in range(0, WIDTH, 2):
            i = y * WIDTH + x
            out += chroma([pixels[i], pixels[i + 1], pixels[i + WIDTH], pixels[i + WIDTH + 1]])
    return out


def words(data):
    return list(struct.unpack(f"<{len(data) // 2}H", data))


def long_words(data):
    return [w & 0xffffff for w in struct.unpack(f"<{len(data) // 4}I", data)]


def last_frame(guest, size):
    """The last of some captured frames."""
    guest.must(f"vmtool capture {IN} 8 /host/captured", 30)
    with open(os.path.join(guest.share, "captured"), "rb") as file:
        return file.read()[-size:]


def outputs(report, guest):
    frames = orbit(VIEWS, WIDTH, HEIGHT)
    frames_565 = [to_565(f) for f in orbit(VIEWS, WIDTH, HEIGHT, "--format", "rgb565")]
    for code, size, read, wanted in (
            ("RGBP", 2 * WIDTH * HEIGHT, words, [frames_565[v] for v in LOOKED_AT]),
            ("XR24", 4 * WIDTH * HEIGHT, long_words, [frames[v] for v in LOOKED_AT]),
            ("YUYV", 2 * WIDTH * HEIGHT, list, [to_yuyv(frames[v]) for v in LOOKED_AT]),
            ("NV12", 3 * WIDTH * HEIGHT // 2, list, [to_nv12(frames[v]) for v in LOOKED_AT])):
        guest.must(f"vmtool loop {OUTPUT} {IN} {WIDTH} {HEIGHT} {code}")
        got = []
        for view in LOOKED_AT:
            program = guest.start(f"oldwell --panel v4l2 --device {OUTPUT} --pixels {code} --size"
                                  f" {WIDTH}x{HEIGHT} --orbit {VIEWS} --first {view} --still"
                                  " --stats /host/oldwell.owt")
            program.wait_for("seconds")
            got.append(read(last_frame(guest, size)))
            program.kill()
            report.equal(f"video {code}: view {view} ends well", program.wait(), 0)
        report.pictures(f"video {code}", f"V4L2 output 320x240 {code}, by capture", got, wanted)
        if code == "RGBP":
            report.control("video: bytes swapped are seen", "V4L2 output, bytes swapped",
                           swapped(got[0]), wanted[0])


def moving(report, guest):
    """Frames that come in while the model turns are whole ones."""
    wanted = [to_565(f) for f in orbit(VIEWS, WIDTH, HEIGHT, "--format", "rgb565")]
    guest.must(f"vmtool loop {OUTPUT} {IN} {WIDTH} {HEIGHT} RGBP")
    program = guest.start(f"oldwell --panel v4l2 --device {OUTPUT} --size {WIDTH}x{HEIGHT}"
                          f" --orbit {VIEWS} --fps 15 --stats /host/oldwell.owt")
    program.wait_for("seconds")
    guest.must(f"vmtool capture {IN} 30 /host/captured", 30)
    program.kill()
    program.wait()
    size = 2 * WIDTH * HEIGHT
    with open(os.path.join(guest.share, "captured"), "rb") as file:
        data = file.read()
    seen = [words(data[i:i + size]) for i in range(0, len(data), size)][4:]
    report.equal("video: moving frames are whole", sum(f not in wanted for f in seen), 0)
    report.check("video: it moves", len(set(map(tuple, seen))) > 2, "it stands still")


def picture(width, height):
    """What the camera sees: no two neighbours alike, no symmetry."""
    return [((x * 31 // width) << 11 | (y * 63 // height) << 5 | (x ^ y) & 31) & 0xffff
            for y in range(height) for x in range(width)]


def backdrop(report, guest):
    """The model's pixels are owsim's, all others the camera's, by a whole step."""
    dark, light = ([to_565(f) for f in orbit(VIEWS, WIDTH, HEIGHT, "--format", "rgb565",
                                             "--background", c)] for c in ("000000", "ffffff"))
    got, wanted, model = [], [], 0
    for view, (width, height) in zip(LOOKED_AT, ((320, 240), (640, 480), (160, 120))):
        camera = picture(width, height)
        with open(os.path.join(guest.share, "frame"), "wb") as file:
            file.write(struct.pack(f"<{len(camera)}H", *camera))
        guest.must(f"vmtool loop {OUTPUT} {IN} {width} {height} RGBP")
        feed = guest.start(f"vmtool feed {OUTPUT} /host/frame")
        feed.wait_for("feeding")
        program = guest.start(f"oldwell --device /dev/fb0 --camera {IN} --orbit {VIEWS}"
                              f" --first {view} --still /host/oldwell.owt")
        want = [d if d == w else camera[i // WIDTH * height // HEIGHT * width +
                                        i % WIDTH * width // WIDTH]
                for i, (d, w) in enumerate(zip(dark[view], light[view]))]
        address, _, _, stride = FRAME_BUFFER
        got.append(soon(lambda: rows_565(guest.memory(address, stride * HEIGHT), WIDTH, HEIGHT,
                                         stride), want))
        wanted.append(want)
        model += sum(d == w for d, w in zip(dark[view], light[view]))
        program.kill()
        report.equal(f"backdrop: {width}x{height} ends well", program.wait(), 0)
        feed.kill("KILL")
        feed.wait()
    report.pictures("backdrop", "camera behind the model, 1:1, 2:1, 1:2", got, wanted)
    report.check("backdrop: the model is there", model > 3000, model)


def faults(report, guest):
    for name, command, status, words_in in (
            ("no such device", f"--device /dev/video9 --size {WIDTH}x{HEIGHT}", 3, "/dev/video9"),
            ("an input for an output", f"--device {IN}", 5, IN),
            ("no permission", f"--device {OUTPUT}", 4, OUTPUT)):
        user = "vmtool as 1000 " if status == 4 else ""
        got, said = guest.sh(f"{user}oldwell --panel v4l2 {command} --once --retry 0"
                             " /host/oldwell.owt 2>&1")
        report.check(f"video: {name}", got == status and words_in in said and "\n" not in said,
                     f"status {got}: {said}")
    got, said = guest.sh("oldwell --panel file --device /tmp/out --camera /dev/video9 --once"
                         " --retry 0 /host/oldwell.owt 2>&1")
    report.check("video: no camera", got == 3 and "/dev/video9" in said, f"status {got}: {said}")


def body(report):
    with Guest("video", ["vivid"], "vivid.n_devs=1 vivid.node_types=0x101", out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        os.link(owt(), os.path.join(guest.share, "oldwell.owt"))
        outputs(report, guest)
        moving(report, guest)
        backdrop(report, guest)
        faults(report, guest)


run("video", body)
