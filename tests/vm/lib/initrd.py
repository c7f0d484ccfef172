#!/usr/bin/env python3
# SPDX-License-Identifier: 0BSD
"""initrd.py KERNEL BUSYBOX INIT OUT MODULE...: writes the guest's first file system.

A cpio archive of busybox, the init script, and the modules with all that they depend on, in
/modules, their order in /modules/order.
"""

import gzip
import lzma
import os
import re
import sys


def find_modules(kernel):
    """The modules' files by name, and the set of those that the kernel has built in."""
    files, builtin = {}, set()
    for folder, _, names in os.walk(kernel):
        for name in names:
            match = re.fullmatch(r"(.*)\.ko(\.xz)?", name)
            if match:
                files[match[1].replace("-", "_")] = os.path.join(folder, name)
            elif name == "modules.builtin":
                with open(os.path.join(folder, name), encoding="ascii") as lines:
                    builtin |= {os.path.basename(n)[:-4].replace("-", "_") for n in lines}
    return files, builtin


def load(path):
    with open(path, "rb") as file:
        data = file.read()
    return lzma.decompress(data) if path.endswith(".xz") else data


def with_dependencies(names, files, builtin):
    """{name: content}, each module after those that it needs."""
    modules = {}

    def add(name):
        name = name.replace("-", "_")
        if name in modules or name in builtin:
            return
        if name not in files:
            sys.exit(f"initrd.py: the kernel has no module {name}")
        data = load(files[name])
        depends = re.search(rb"\0depends=([^\0]*)\0", data)
        for other in depends[1].decode().split(",") if depends else []:
            if other:
                add(other)
        modules[name] = data

    for name in names:
        add(name)
    return modules


class Cpio:
    """An archive in the format that the kernel unpacks ("newc")."""

    def __init__(self):
        self.data = bytearray()
        self.count = 0

    def add(self, name, mode, content=b""):
        self.count += 1
        fields = [self.count, mode, 0, 0, 1, 0, len(content), 0, 0, 0, 0, len(name) + 1, 0]
        self.data += b"070701" + b"".join(b"%08X" % f for f in fields) + name.encode() + b"\0"
        self.data += bytes(-len(self.data) % 4) + content
        self.data += bytes(-len(self.data) % 4)

    def finished(self):
        self.add("TRAILER!!!", 0)
        return self.data


def main():
    kernel, busybox, init, out = sys.argv[1:5]
    modules = with_dependencies(sys.argv[5:], *find_modules(kernel))
    archive = Cpio()
    for folder in ("bin", "dev", "proc", "sys", "tmp", "host", "modules"):
        archive.add(folder, 0o040755)
    archive.add("bin/busybox", 0o100755, load(busybox))
    archive.add("init", 0o100755, load(init))
    for name, data in modules.items():
        archive.add(f"modules/{name}.ko", 0o100644, data)
    archive.add("modules/order", 0o100644, "".join(f"{m}\n" for m in modules).encode())
    with open(out + ".part", "wb") as file:
        file.write(gzip.compress(archive.finished(), 1))
    os.rename(out + ".part", out)


main()
