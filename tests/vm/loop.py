# SPDX-License-Identifier: 0BSD
"""oldwell's loop on a frame buffer: heap, processor time, signals, a changed tree."""

import json
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from check import OUT, orbit, owt, rows_565, run, soon, to_565
from guest import Guest
from heap import Heap

FRAME = (0x5f000000, 320, 240, 672)


def screen(guest):
    address, width, height, stride = FRAME
    return rows_565(guest.memory(address, stride * height), width, height, stride)


def stats(program):
    return [json.loads(line) for line in program.errors().splitlines() if line[:1] == "{"]


def heap(report, guest):
    watch = Heap(guest, f"{OUT}/gpiod2/oldwell", "/tmp/oldwell")
    program = guest.start("/tmp/oldwell --orbit 90 --stats /host/oldwell.owt")
    soon(lambda: len(stats(program)) >= 1, True)
    before, lines = watch.calls(), len(stats(program))
    soon(lambda: len(stats(program)) >= lines + 2, True)
    after = watch.calls()
    frames = sum(s["frames"] for s in stats(program)[lines:])
    program.kill()
    program.wait()
    watch.close()
    report.check("loop: the probes count the start's calls", before["malloc"] > 0, before)
    report.check("loop: it draws", frames >= 10, f"{frames} frames")
    report.equal("loop: no call of the heap while it draws", after, before)


def processor(report, guest):
    """CPU time at rest, from the scheduler's own count in nanoseconds."""
    program = guest.start("oldwell --still /host/oldwell.owt")
    soon(lambda: screen(guest) == still(), True)
    time.sleep(0.5)
    own, child = program.pid, program.child()
    used = f"cat /proc/{own}/task/*/schedstat /proc/{child}/task/*/schedstat; cut -d' ' -f1 /proc/uptime"

    def read():
        lines = guest.must(used).splitlines()
        return sum(int(line.split()[0]) for line in lines[:-1]), float(lines[-1])

    ns0, s0 = read()
    time.sleep(4)
    ns1, s1 = read()
    report.check("loop: two processes are looked at", own != child and ns0 > 10000000, ns0)
    share = (ns1 - ns0) / 1e9 / (s1 - s0)
    print(f"processor time at rest: {100 * share:.3f} %")
    report.check("loop: at rest under 1 % of the processor", share < 0.01, f"{100 * share:.2f} %")
    program.kill()
    report.equal("loop: SIGTERM ends it", program.wait(), 0)


def still(tree=None):
    return to_565(orbit(1, 320, 240, "--format", "rgb565", tree=tree)[0])


def reload(report, guest):
    """A new tree in the old one's place, a bad one, and none."""
    guest.must("cp /host/oldwell.owt /tmp/shown.owt")
    program = guest.start("oldwell --still /tmp/shown.owt")
    wanted = still()
    soon(lambda: screen(guest), wanted)
    cubes = still(owt("cubes"))
    guest.must("cp /host/cubes.owt /tmp/new && mv /tmp/new /tmp/shown.owt")
    report.equal("loop: a changed tree is shown", soon(lambda: screen(guest), cubes) == cubes, True)
    guest.must("dd if=/host/oldwell.owt of=/tmp/new bs=1000 count=3 2>/dev/null;"
               " mv /tmp/new /tmp/shown.owt")
    program.wait_for("/tmp/shown.owt")
    time.sleep(0.5)
    report.equal("loop: a broken tree is told, the old one stays",
                 (program.alive(), screen(guest) == cubes), (True, True))
    guest.must("cp /host/oldwell.owt /tmp/new && mv /tmp/new /tmp/shown.owt")
    program.kill("HUP")
    report.equal("loop: SIGHUP", soon(lambda: screen(guest), wanted) == wanted, True)
    program.kill("INT")
    report.equal("loop: SIGINT ends it", program.wait(), 0)


def body(report):
    tree = owt()
    with Guest("loop", out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        os.link(tree, os.path.join(guest.share, "oldwell.owt"))
        os.link(owt("cubes"), os.path.join(guest.share, "cubes.owt"))
        guest.must("cp /host/bin/oldwell /tmp/oldwell")
        processor(report, guest)
        heap(report, guest)
        reload(report, guest)


run("loop", body)
