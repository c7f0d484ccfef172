# SPDX-License-Identifier: 0BSD
# The tests against real kernel drivers, in a guest (tests/vm).
.PHONY: vm-check vm-programs
vm-check: ## oldwell on a real kernel's drivers, in an emulated arm64 machine
	@scripts/setup check vm
	@scripts/vm-check

# CC for the guest: arm64, static, with the libraries that scripts/vm-parts fetched.
vm_parts := build/vm/parts
vm_cc     = $(if $(filter aarch64,$(shell uname -m)),gcc,aarch64-linux-gnu-gcc) \
            --sysroot=$(abspath $(vm_parts)/sysroot) -static

vm-programs: $(O)/vm/analyser $(O)/vm/vmtool
$(O)/vm/analyser: tests/vm/lib/analyser.c
	@mkdir -p $(@D)
	@echo "  cc $@"
	$(Q)$(CC) $(host_flags) $(LDFLAGS) -o $@ $<
$(O)/vm/vmtool: $(wildcard tests/vm/tool/*.c) tests/vm/tool/tool.h | vm-parts
	@mkdir -p $(@D)
	@echo "  cc $@"
	$(Q)$(vm_cc) -std=c11 -D_DEFAULT_SOURCE -O2 $(warnings) -I. -o $@ $(filter %.c,$^)

.PHONY: vm-parts
vm-parts:
	@scripts/vm-parts >build/vm-parts.log 2>&1 || { tail -n 5 build/vm-parts.log >&2; exit 1; }
