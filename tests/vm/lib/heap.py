# SPDX-License-Identifier: 0BSD
"""Counts a program's calls of the heap from outside, by the kernel's probes on its functions."""

import subprocess

FUNCTIONS = ("malloc", "calloc", "realloc", "free")
TRACING = "/sys/kernel/tracing"


def file_offset(binary, function):
    """Where a function of a static program begins in its file."""
    tool = "readelf"
    symbols = subprocess.run([tool, "-sW", binary], check=True, capture_output=True,
                             text=True).stdout
    address = next(int(f[1], 16) for f in map(str.split, symbols.splitlines())
                   if len(f) == 8 and f[3] == "FUNC" and f[7] == function)
    segments = subprocess.run([tool, "-lW", binary], check=True, capture_output=True,
                              text=True).stdout
    for fields in map(str.split, segments.splitlines()):
        if fields[:1] == ["LOAD"]:
            offset, start, size = (int(fields[i], 16) for i in (1, 2, 4))
            if start <= address < start + size:
                return address - start + offset
    raise ValueError(f"{binary}: {function} lies in no segment")


class Heap:
    """Probes on the program `path` inside the guest, a copy of `binary`. Needs the symbols."""

    def __init__(self, guest, binary, path):
        self.guest = guest
        guest.sh(f"mount -t tracefs tracefs {TRACING}")
        for function in FUNCTIONS:
            guest.must(f"echo 'p:heap/{function} {path}:{file_offset(binary, function):#x}'"
                       f" >>{TRACING}/uprobe_events")
        guest.must(f"echo 1 >{TRACING}/events/heap/enable")

    def calls(self):
        """How often each function was called so far, by all processes."""
        lines = self.guest.must(f"cat {TRACING}/uprobe_profile").splitlines()
        return {f[-2]: int(f[-1]) for f in map(str.split, lines) if f[-2] in FUNCTIONS}

    def close(self):
        self.guest.sh(f"echo 0 >{TRACING}/events/heap/enable; echo >{TRACING}/uprobe_events")
