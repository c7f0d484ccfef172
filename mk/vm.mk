# SPDX-License-Identifier: 0BSD
# The tests against real kernel drivers, in a guest (tests/vm).
.PHONY: vm-check vm-programs
vm-check: ## oldwell on a real kernel's drivers, in an emulated arm64 machine
	@scripts/setup check vm
	@scripts/vm-check

# For the guest all is arm64 and static: oldwell with either interface of libgpiod.
vm-programs: $(O)/vm/analyser $(O)/vm/vmtool vm-oldwell-gpiod1 vm-oldwell-gpiod2

$(O)/vm/analyser: tests/vm/lib/analyser.c
	@mkdir -p $(@D)
	@echo "  cc $@"
	$(Q)$(CC) $(host_flags) $(LDFLAGS) -o $@ $<

vm_cc = $(patsubst CC=%,%,$(shell scripts/vm-parts --variables gpiod2 | grep ^CC=))
$(O)/vm/vmtool: $(wildcard tests/vm/tool/*.c) tests/vm/tool/tool.h | vm-parts
	@mkdir -p $(@D)
	@echo "  cc $@"
	$(Q)$(vm_cc) -static -std=c11 -D_DEFAULT_SOURCE -O2 $(warnings) -I. -o $@ $(filter %.c,$^)

.PHONY: vm-oldwell-%
vm-oldwell-%: | vm-parts
	+@scripts/vm-parts --variables $* | tr '\n' '\0' | \
	    xargs -0 $(MAKE) --no-print-directory O=$(O)/vm/$* CFLAGS=-O2 $(O)/vm/$*/oldwell

.PHONY: vm-parts
vm-parts:
	@mkdir -p build/log
	@scripts/vm-parts >build/log/vm-parts.log 2>&1 || \
	    { tail -n 5 build/log/vm-parts.log >&2; exit 1; }
