# SPDX-License-Identifier: 0BSD
# Linux boards: the program oldwell and its tests in a guest.
# STATIC=1 links it without shared libraries, as a guest's or a rescue system's root wants it.

linux_src := $(wildcard hal/linux/*.c boards/linux/*.c)
viewer_src := $(wildcard firmware/viewer/*.c hal/panel/*.c)

$(O)/oldwell.a: $(call parts,$(linux_src) $(viewer_src))
$(O)/oldwell: $(call mains,$(linux_src)) $(O)/oldwell.a $(O)/common.a $(O)/core.a
	@echo "  ld $@"
	$(Q)$(link_program) $(if $(STATIC),-static) -lm
	$(Q)$(finish)

programs: $(O)/oldwell

.PHONY: vm-check
vm-check:
	@echo "make: $@ is not there yet" >&2; exit 2
