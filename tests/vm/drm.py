# SPDX-License-Identifier: 0BSD
"""oldwell --panel drm: every pixel, whole pages, other masters, a card that goes and comes back."""

import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from check import OUT, orbit, owt, rgb, run, soon, watch
from guest import Guest

VIEWS = 8
LOOKED_AT = (0, 3, 6)
CARD = "/dev/dri/card0"
TURNING = f"oldwell --panel drm --device {CARD} --orbit {VIEWS} --fps 10 /host/oldwell.owt"
STILL = f"oldwell --panel drm --device {CARD} --orbit {VIEWS} --still /host/oldwell.owt"


class Screen:
    """The guest with its screen, and the pictures that belong there."""

    def __init__(self, guest):
        self.guest = guest
        self.wanted = orbit(VIEWS, 320, 240)

    def look(self):
        width, _, data = self.guest.screen()
        return rgb(data) if width == 320 else []

    def moves(self):
        """It shows whole frames, and not always the same."""
        first = self.look()
        time.sleep(0.3)
        second = self.look()
        return first != second and first in self.wanted and second in self.wanted

    def shows(self, view, seconds=10):
        return soon(self.look, self.wanted[view], seconds) == self.wanted[view]


def pictures(report, guest, screen):
    seen = []
    for view in LOOKED_AT:
        program = guest.start(f"{STILL} --first {view}")
        seen.append(soon(screen.look, screen.wanted[view]))
        program.kill()
        report.equal(f"drm: view {view} ends well", program.wait(), 0)
    report.pictures("drm", "DRM on virtio-gpu 320x240", seen, [screen.wanted[v] for v in LOOKED_AT])
    red_and_blue = [(p & 255) << 16 | p & 0xff00 | p >> 16 for p in seen[0]]
    report.control("drm: red and blue exchanged are seen", "DRM, red and blue exchanged",
                   red_and_blue, screen.wanted[0])


def moving(report, guest, screen):
    program = guest.start(TURNING)
    soon(lambda: screen.look() in screen.wanted, True)
    seen = watch(screen.look, 3)
    report.equal("drm: pages change whole", sum(list(p) not in screen.wanted for p in seen), 0)
    report.check("drm: it moves", len(set(seen)) > 2, "it stands still")
    program.kill()
    program.wait()
    got, output = guest.sh("oldwell --panel drm --once --depth 16 --retry 0 /host/oldwell.owt 2>&1")
    report.check("drm: 16 bits are shown or refused", got in (0, 5) and output.count("\n") == 0,
                 f"status {got}: {output}")


def masters(report, guest, screen):
    """Another program has the screen, before and while oldwell runs."""
    other = guest.start(f"vmtool master {CARD}")
    other.wait_for("master")
    got, output = guest.sh(f"{STILL} --retry 0 2>&1")
    report.check("drm: a busy screen", got == 3 and CARD in output and output.count("\n") == 0,
                 f"status {got}: {output}")
    program = guest.start(f"{TURNING} --wait 20")
    time.sleep(0.5)
    other.kill("KILL")
    report.check("drm: it waits for the screen", soon(screen.moves, True),
                 program.errors())

    other = guest.start(f"vmtool master {CARD} {program.child()}")
    other.wait_for("master")
    time.sleep(0.5)
    stands = not screen.moves()
    report.check("drm: the screen is taken away: told, and not the end",
                 stands and program.alive() and CARD in program.errors(), program.errors())
    other.kill("KILL")
    report.check("drm: the screen comes back", soon(screen.moves, True),
                 program.errors())
    program.kill()
    report.equal("drm: and it ends well", program.wait(), 0)


def unplugged(report, guest, screen):
    driver = "/sys/bus/virtio/drivers/virtio_gpu"
    device = guest.must(f"cd {driver}; echo virtio*")
    program = guest.start(f"{TURNING} --retry 3")
    soon(lambda: screen.look() in screen.wanted, True)
    guest.must(f"echo {device} >{driver}/unbind")
    status = program.wait(20)
    report.check("drm: the card goes", status in (3, 5) and CARD in program.errors(),
                 f"status {status}: {program.errors()}")
    got, output = guest.sh(f"{STILL} --retry 0 2>&1")
    report.check("drm: no card", got == 3 and CARD in output, f"status {got}: {output}")

    guest.must(f"echo {device} >{driver}/bind")
    program = guest.start(f"{STILL} --retry 30")
    report.check("drm: the card is back", screen.shows(0), program.errors())
    guest.must(f"echo {device} >{driver}/unbind")
    program.kill("HUP")
    time.sleep(0.5)
    guest.must(f"echo {device} >{driver}/bind")
    report.check("drm: it goes on when the card comes back", screen.shows(0, 15), program.errors())
    program.kill()
    report.equal("drm: and ends well", program.wait(), 0)


def body(report):
    tree = owt()
    with Guest("drm", ["virtio-gpu"], "", ["-device", "virtio-gpu-pci,xres=320,yres=240"],
               out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        os.link(tree, os.path.join(guest.share, "oldwell.owt"))
        screen = Screen(guest)
        pictures(report, guest, screen)
        moving(report, guest, screen)
        denied = guest.sh(f"vmtool as 1000 {STILL} --retry 0 2>&1")
        report.check("drm: no permission", denied[0] == 4 and CARD in denied[1], denied)
        masters(report, guest, screen)
        unplugged(report, guest, screen)


run("drm", body)
