# SPDX-License-Identifier: 0BSD
"""The guest: starts QEMU, runs commands inside, moves its pins, looks at its screens and memory."""

import json
import os
import re
import select
import shutil
import socket
import subprocess
import tempfile
import time

MODULES = ["virtio_pci", "9p", "9pnet_virtio"]
MACHINE = ["-M", "virt", "-cpu", "cortex-a53", "-m", "512", "-nodefaults", "-display", "none"]
HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = os.path.join(HERE, "../../../build/vm/parts")


class GuestError(Exception):
    """The guest did not do what was asked: it died, or did not answer in time."""


def device_tree(folder):
    """The machine's own tree with virt.dtsi, compiled into the folder."""
    out = os.path.join(folder, "virt.dtb")
    dump = os.path.join(folder, "dump.dtb")
    machine = [m if m != "virt" else f"virt,dumpdtb={dump}" for m in MACHINE]
    subprocess.run(["qemu-system-aarch64", *machine], check=True, stderr=subprocess.DEVNULL)
    source = subprocess.run(["dtc", "-q", "-I", "dtb", "-O", "dts", dump], check=True,
                            capture_output=True, text=True).stdout
    with open(os.path.join(HERE, "virt.dtsi"), encoding="utf-8") as file:
        source += file.read()
    subprocess.run(["dtc", "-q", "-I", "dts", "-O", "dtb", "-o", out, "-"], check=True,
                   input=source, text=True)
    return out


class Lines:
    """Lines from a socket, with a time limit."""

    def __init__(self, path, alive):
        end = time.monotonic() + 20
        self.socket = socket.socket(socket.AF_UNIX)
        while True:
            try:
                self.socket.connect(path)
                break
            except OSError as error:
                if not alive() or time.monotonic() > end:
                    raise GuestError(f"{path}: {error}") from error
                time.sleep(0.02)
        self.rest = b""

    def send(self, text):
        self.socket.sendall(text.encode())

    def next(self, seconds):
        """The next line without its end; None if the time is over."""
        end = time.monotonic() + seconds
        while b"\n" not in self.rest:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.socket], [], [], left)[0]:
                return None
            data = self.socket.recv(65536)
            if not data:
                raise GuestError("the guest closed the line")
            self.rest += data
        line, self.rest = self.rest.split(b"\n", 1)
        return line.decode(errors="replace")


class Guest:
    """One running guest. Use it in a `with`; `share` is /host inside, programs go to share/bin."""

    def __init__(self, name, modules=(), append="", devices=(), trace=None, out="build/vm"):
        self.folder = os.path.abspath(os.path.join(out, name))
        shutil.rmtree(self.folder, ignore_errors=True)
        self.share = os.path.join(self.folder, "share")
        os.makedirs(os.path.join(self.share, "bin"))
        # A socket's path must be short.
        self.sockets = tempfile.mkdtemp(prefix="ow-vm-")
        self.number = 0
        self.running = 0
        initrd = os.path.join(self.folder, "initrd")
        subprocess.run(["python3", os.path.join(HERE, "initrd.py"), f"{PARTS}/kernel",
                        f"{PARTS}/busybox/bin/busybox", os.path.join(HERE, "init"), initrd,
                        *MODULES, *modules], check=True)
        command = ["qemu-system-aarch64", *MACHINE, "-no-reboot", "-monitor", "none",
                   "-kernel", f"{PARTS}/kernel/vmlinuz", "-initrd", initrd,
                   "-dtb", device_tree(self.folder),
                   "-append", f"console=ttyAMA0 quiet panic=-1 {append}",
                   "-serial", f"file:{self.folder}/console.log",
                   "-device", "virtio-serial-pci",
                   "-chardev", f"socket,id=port,path={self.sockets}/port,server=on,wait=off",
                   "-device", "virtserialport,chardev=port",
                   "-fsdev", f"local,id=host,path={self.share},security_model=none",
                   "-device", "virtio-9p-pci,fsdev=host,mount_tag=host",
                   "-qmp", f"unix:{self.sockets}/qmp,server=on,wait=off",
                   "-qtest", f"unix:{self.sockets}/qtest,server=on,wait=off",
                   "-qtest-log", "/dev/null", *devices]
        if trace:
            command += ["-msg", "timestamp=on", "-trace", "pl061_set_output", "-D", trace]
        with open(os.path.join(self.folder, "qemu.log"), "wb") as log:
            self.qemu = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        self.port = self.qmp_lines = self.qtest_lines = self.pl061 = None

    def __enter__(self):
        try:
            self.port = self._open("port")
            self.qmp_lines = self._open("qmp")
            self.qtest_lines = self._open("qtest")
            self.qmp("qmp_capabilities")
            for device in self.qmp("qom-list", path="/machine/unattached"):
                if device["type"] == "child<pl061>":
                    self.pl061 = "/machine/unattached/" + device["name"]
            self._answer(0, 60)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.qemu.poll() is None:
            self.qemu.terminate()
        self.qemu.wait()
        shutil.rmtree(self.sockets, ignore_errors=True)

    def _open(self, name):
        return Lines(f"{self.sockets}/{name}", lambda: self.qemu.poll() is None)

    def console(self):
        with open(f"{self.folder}/console.log", encoding="utf-8", errors="replace") as file:
            return file.read()

    # ---- commands inside -------------------------------------------------------------------
    def _answer(self, number, seconds):
        lines = []
        end = time.monotonic() + seconds
        while True:
            line = self.port.next(end - time.monotonic())
            if line is None:
                raise GuestError(f"no answer in {seconds} s, so far: {lines}; {self.console()}")
            match = re.fullmatch(r"@@ (\d+) (\d+)", line)
            if match and int(match[1]) == number:
                return int(match[2]), "\n".join(lines).rstrip("\n")
            lines.append(line)

    def sh(self, command, seconds=30):
        """Runs a shell command to its end: its exit status and its output."""
        self.number += 1
        self.port.send(f"{self.number} {command}\n")
        return self._answer(self.number, seconds)

    def must(self, command, seconds=30):
        """As sh, for commands that are not on trial: raises if they fail."""
        status, output = self.sh(command, seconds)
        if status != 0:
            raise GuestError(f"{command}: status {status}: {output}")
        return output

    def install(self, *programs):
        for path in programs:
            shutil.copy(path, os.path.join(self.share, "bin"))

    def start(self, command):
        """Starts a command that goes on; its standard error and output go to files."""
        return Running(self, command)

    # ---- from outside ----------------------------------------------------------------------
    def qmp(self, command, **arguments):
        self.qmp_lines.send(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        while True:
            line = self.qmp_lines.next(20)
            if line is None:
                raise GuestError(f"no answer to {command}")
            answer = json.loads(line)
            if "error" in answer:
                raise GuestError(f"{command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def pin(self, line, level):
        """Drives a line of the PL061 from outside."""
        self.qtest_lines.send(f"set_irq_in {self.pl061} unnamed-gpio-in {line} {int(level)}\n")
        answer = self.qtest_lines.next(10)
        if answer is None or not answer.startswith("OK"):
            raise GuestError(f"qtest: {answer}")

    def memory(self, address, size):
        path = f"{self.sockets}/memory"
        self.qmp("pmemsave", val=address, size=size, filename=path)
        with open(path, "rb") as file:
            return file.read()

    def screen(self):
        """What the virtio-gpu shows: (width, height, RGB bytes)."""
        path = f"{self.sockets}/screen"
        self.qmp("screendump", filename=path)
        with open(path, "rb") as file:
            data = file.read()
        match = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
        return int(match[1]), int(match[2]), data[match.end():]


class Running:
    """A program that goes on inside the guest."""

    def __init__(self, guest, command):
        guest.running += 1
        self.guest = guest
        self.name = f"/tmp/run{guest.running}"
        n = self.name
        # The shell that waits keeps the exit status for later.
        guest.must(f"(({command}) >{n}.out 2>{n}.err & echo $! >{n}.pid; wait $!;"
                   f" echo $? >{n}.status) >/dev/null 2>&1 & until [ -s {n}.pid ]; do :; done")
        self.pid = int(guest.must(f"cat {n}.pid"))

    def errors(self):
        return self.guest.must(f"cat {self.name}.err")

    def output(self):
        return self.guest.must(f"cat {self.name}.out")

    def alive(self):
        return self.guest.sh(f"[ ! -s {self.name}.status ]")[0] == 0

    def child(self):
        """The process that it started; itself, if it started none."""
        status = self.guest.must("cat /proc/[0-9]*/stat 2>/dev/null; :").splitlines()
        for name, rest in (line.rsplit(") ", 1) for line in status):
            if rest.split()[1] == str(self.pid):
                return int(name.split()[0])
        return self.pid

    def kill(self, name="TERM", pid=None):
        self.guest.sh(f"kill -{name} {pid or self.pid}")

    def wait(self, seconds=20):
        """Its exit status (128 + n for a signal), once it has ended."""
        status, _ = self.guest.sh(f"t=$(({seconds} * 20)); until [ -s {self.name}.status ];"
                                  " do t=$((t - 1)); [ $t -gt 0 ] || exit 1; usleep 50000; done",
                                  seconds + 30)
        if status != 0:
            raise GuestError(f"pid {self.pid} does not end: {self.errors()}")
        return int(self.guest.must(f"cat {self.name}.status"))

    def wait_for(self, text, seconds=20):
        """Waits until its standard error or output holds the text."""
        status, _ = self.guest.sh(
            f"t=$(({seconds} * 20)); until grep -qF '{text}' {self.name}.err {self.name}.out;"
            f" do t=$((t - 1)); [ $t -gt 0 -a ! -s {self.name}.status ] || exit 1; usleep 50000;"
            " done", seconds + 30)
        if status != 0:
            raise GuestError(f"'{text}' does not come: {self.errors()}")
