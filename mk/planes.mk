# SPDX-License-Identifier: 0BSD
# The core and the viewer once more, compiled to read trees from bit planes (OW_STRIDE bytes
# apart), as single objects whose names have a prefix: programs on a host can have all of them.
planes_src := $(core_src) $(wildcard firmware/viewer/*.c) boards/sim/engine.c
planes_tool = $(shell $(CC) -print-prog-name=$(1))

# planes N: $(O)/planesN.o.
define planes
$(O)/planes$(1)/%.o: %.c $(O)/flags
	@mkdir -p $$(@D)
	@echo "  cc $$< (stride $(1))"
	$(Q)$$(CC) $$(core_flags) -DOW_STRIDE=$(1) -MMD -MP -c -o $$@ $$<
$(O)/planes$(1).o: $(planes_src:%.c=$(O)/planes$(1)/%.o)
	@echo "  ld $$@"
	$(Q)$$(call planes_tool,ld) -r -o $$@ $$^
	$(Q)$$(call planes_tool,nm) -g --defined-only $$@ | \
	    sed -n 's/^[^ ]* [A-Z] \(ow_[a-z0-9_]*\)$$$$/\1 planes$(1)_\1/p; s/^[^ ]* [A-Z] \(viewer_[a-z0-9_]*\)$$$$/\1 planes$(1)_\1/p' >$$@.names
	$(Q)$$(call planes_tool,objcopy) --redefine-syms=$$@.names $$@
-include $$(shell find $(O)/planes$(1) -name '*.d' 2>/dev/null)
endef
$(eval $(call planes,3))
$(eval $(call planes,4))

$(O)/owsim: $(O)/planes3.o $(O)/planes4.o

$(O)/tests/test_planes: $(O)/planes3.o $(O)/planes4.o
