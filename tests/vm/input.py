# SPDX-License-Identifier: 0BSD
"""oldwell's inputs: edges at the guest's pins, and an input device made by uinput.

What the model then looks like must be what owsim draws after the same events.
"""

import os
import shutil
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "lib"))
# pylint: disable=wrong-import-position
from check import OUT, owsim, owt, rows_565, run, soon, to_565
from guest import Guest
from heap import Heap

FRAME = (0x5f000000, 320, 240, 672)
KEY, ENC_A, ENC_B = 3, 6, 7
EV_KEY, EV_ABS = 1, 3
KEY_LEFT, KEY_UP = 105, 103
ABS_X = 0


def screen(guest):
    address, width, height, stride = FRAME
    return rows_565(guest.memory(address, stride * height), width, height, stride)


def after(*events):
    """owsim's picture once these events have happened, `CONTROL KIND VALUE` each."""
    script = os.path.join(OUT, "input.script")
    with open(script, "w", encoding="ascii") as file:
        for number, event in enumerate(events):
            control, *rest = event.split()
            if rest == ["tap"]:
                file.write(f"{100 * number + 1} {control} press\n")
                file.write(f"{100 * number + 2} {control} release\n")
            else:
                file.write(f"{100 * number + 1} {event}\n")
    return to_565(owsim(owt(), "--orbit", 1, "--size", "320x240", "--format", "rgb565",
                        *(["--script", script] if events else []))[-1])


def turn(guest, detents):
    """The knob by so many detents, clockwise if positive: A leads B."""
    first, second = (ENC_A, ENC_B) if detents > 0 else (ENC_B, ENC_A)
    for _ in range(abs(detents)):
        for pin, level in ((first, 1), (second, 1), (first, 0), (second, 0)):
            guest.pin(pin, level)
            time.sleep(0.03)


def tap(guest):
    guest.pin(KEY, 1)
    time.sleep(0.03)
    guest.pin(KEY, 0)
    time.sleep(0.03)


def pins(report, guest, program):
    number = 1 if program.endswith("1") else 2
    name = f"libgpiod {number}"
    guest.must(f"cp /host/bin/{program} /tmp")
    watch = Heap(guest, f"{OUT}/gpiod{number}/oldwell", f"/tmp/{program}")
    shown = guest.start(f"/tmp/{program} --still --buttons select=!KEY --knobs knob1=ENC_A+ENC_B"
                        " /host/oldwell.owt")
    home = after()
    report.check(f"input ({name}): it begins at home", soon(lambda: screen(guest), home) == home,
                 shown.errors())
    before = watch.calls()
    turn(guest, 3)
    wanted = after("knob1 turn 3")
    report.check(f"input ({name}): three detents", soon(lambda: screen(guest), wanted) == wanted,
                 shown.errors())
    turn(guest, -5)
    wanted = after("knob1 turn -2")
    report.check(f"input ({name}): five back", soon(lambda: screen(guest), wanted) == wanted,
                 shown.errors())
    # Half a detent and back is none.
    for level in (1, 0, 1, 0):
        guest.pin(ENC_A, level)
        time.sleep(0.03)
    time.sleep(0.5)
    report.check(f"input ({name}): a trembling knob does not move it", screen(guest) == wanted, "")
    tap(guest)
    report.check(f"input ({name}): the button leads home",
                 soon(lambda: screen(guest), home) == home, shown.errors())
    report.check(f"input ({name}): no call of the heap by all this",
                 watch.calls() == before and before["malloc"] > 0, (before, watch.calls()))
    shown.kill()
    report.equal(f"input ({name}): it ends well", shown.wait(), 0)
    watch.close()


def keys(report, guest):
    guest.must("mkfifo /tmp/orders")
    device = guest.start("vmtool keys /tmp/orders")
    device.wait_for("keys")
    shown = guest.start("oldwell --still --input vmtool /host/oldwell.owt")
    home = after()
    soon(lambda: screen(guest), home)

    def send(*event):
        guest.must(f"echo {' '.join(map(str, event))} >/tmp/orders")

    send(EV_ABS, ABS_X, 500)
    wanted = after("axis-x axis 16383")
    report.check("input (evdev): a joystick", soon(lambda: screen(guest), wanted) == wanted,
                 shown.errors())
    send(EV_ABS, ABS_X, 0)
    guest.must(f"printf '{EV_KEY} {KEY_UP} 1\\n{EV_KEY} {KEY_UP} 0\\n' >/tmp/orders")
    # A slow guest may hold the key long enough to repeat.
    several = [after(*["up tap"] * n) for n in range(1, 6)]
    report.check("input (evdev): a key", soon(lambda: screen(guest) in several, True),
                 shown.errors())
    device.kill("KILL")
    device.wait()
    time.sleep(0.5)
    report.check("input (evdev): the device may go", shown.alive(), shown.errors())
    device = guest.start("vmtool keys /tmp/orders")
    device.wait_for("keys")

    def joystick():
        """Moved again and again, for the program looks for the device now and then only."""
        send(EV_ABS, ABS_X, -1000)
        send(EV_ABS, ABS_X, -500)
        time.sleep(0.3)
        return screen(guest)

    report.check("input (evdev): and come back", soon(lambda: joystick() not in several, True),
                 shown.errors())
    device.kill("KILL")
    shown.kill()
    report.equal("input (evdev): it ends well", shown.wait(), 0)


def faults(report, guest):
    for name, options, status, words in (
            ("no such line", "--buttons select=NOPE", 3, "NOPE"),
            ("no such device", "--input /dev/input/event99", 3, "event99")):
        got, said = guest.sh(f"oldwell --once --retry 0 {options} /host/oldwell.owt 2>&1")
        report.check(f"input: {name}", got == status and words in said, f"status {got}: {said}")


def body(report):
    with Guest("input", ["evdev", "uinput"], out=OUT) as guest:
        guest.install(f"{OUT}/vmtool", f"{OUT}/gpiod2/oldwell")
        shutil.copy(f"{OUT}/gpiod1/oldwell", os.path.join(guest.share, "bin/oldwell1"))
        os.link(owt(), os.path.join(guest.share, "oldwell.owt"))
        pins(report, guest, "oldwell")
        pins(report, guest, "oldwell1")
        keys(report, guest)
        faults(report, guest)


run("input", body)
