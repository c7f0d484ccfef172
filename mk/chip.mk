# SPDX-License-Identifier: 0BSD
# Boards without an operating system: make BOARD=NAME [run] [TREE=FILE.owt].
# The board's folder has main.c, tree.S and board.ld; here is what else it is made of.
bare_boards := lm3s6965evb raspi2b raspi2b-planes

# The core is compiled like this for `make size` and for every chip: small, no LTO.
bare_flags = -std=c11 -ffreestanding -Os -g $(warnings) -ffunction-sections -fdata-sections \
             -fno-common -I. -Ifirmware/core
bare_link  = -nostdlib -Wl,--gc-sections -Wl,--fatal-warnings -Wl,--no-warn-rwx-segments -lgcc

lm3s6965evb_tools := arm-none-eabi-
lm3s6965evb_cpu   := -mcpu=cortex-m3 -mthumb
lm3s6965evb_hal   := $(wildcard hal/lm3s6965/*.c)
lm3s6965evb_qemu  := qemu-system-arm -M lm3s6965evb

raspi2b_tools := arm-none-eabi-
raspi2b_cpu   := -mcpu=cortex-a7 -marm -mfloat-abi=soft -O2
# For the board's own folder: make BOARD=raspi2b FRAME_WIDTH=800 FRAME_HEIGHT=600 FRAME_BITS=16
raspi2b_board := $(if $(FRAME_WIDTH),-DFRAME_WIDTH=$(FRAME_WIDTH) -DFRAME_HEIGHT=$(FRAME_HEIGHT)) \
                 $(if $(FRAME_BITS),-DFRAME_BITS=$(FRAME_BITS))
raspi2b_hal   := $(wildcard hal/bcm2836/*.c hal/bcm2836/*.S)
raspi2b_qemu  := qemu-system-arm -M raspi2b
# The same, with the tree in the frame buffer's spare bit planes.
raspi2b-planes_tools  := $(raspi2b_tools)
raspi2b-planes_cpu    := $(raspi2b_cpu) -DOW_STRIDE=4
raspi2b-planes_board  := $(raspi2b_board)
raspi2b-planes_hal    := $(raspi2b_hal)
raspi2b-planes_qemu   := $(raspi2b_qemu)
raspi2b-planes_folder := raspi2b

# Of the chip with little memory only the scenes and the size: a tree of 4 bytes a byte in flash.
lm3s6965evb-planes_tools  := $(lm3s6965evb_tools)
lm3s6965evb-planes_cpu    := $(lm3s6965evb_cpu) -DOW_STRIDE=4
lm3s6965evb-planes_hal    := $(lm3s6965evb_hal)
lm3s6965evb-planes_folder := lm3s6965evb
lm3s6965evb-planes_spread := .spread

# The built-in tree: the Old Well, or TREE.
TREE ?= $(O)/chip/oldwell.owt
$(O)/chip/oldwell.obj: $(O)/owgen
	@mkdir -p $(@D)
	$(Q)$(O)/owgen oldwell --detail high -o $@
$(O)/chip/oldwell.owt: $(O)/chip/oldwell.obj $(O)/owc
	$(Q)$(O)/owc $< -o $@ 2>$(@:.owt=.log)
# Spread over pixels, as planes of a frame buffer would hold it.
$(O)/chip/%.owt.spread: $(O)/chip/%.owt $(O)/tests/spread
	$(Q)$(O)/tests/spread 4 <$< >$@
# One with normals, small enough for a chip to receive.
$(O)/chip/smooth.owt: $(O)/owgen $(O)/owc
	@mkdir -p $(@D)
	$(Q)$(O)/owgen oldwell --detail low -o $(@:.owt=.obj)
	$(Q)$(O)/owc $(@:.owt=.obj) --normals compute -o $@ 2>$(@:.owt=.log)

device_src := $(wildcard firmware/core/*.c firmware/viewer/*.c firmware/device/*.c hal/panel/*.c) \
              $(wildcard hal/bare/*.c)

# The folder of board $(1), if it is not its name.
folder = $(or $($(1)_folder),$(1))

# bare_program BOARD PROGRAM SOURCES: PROGRAM.elf of these sources.
define bare_program
$(O)/$(2).elf: $(patsubst %,$(O)/$(1)/%.o,$(basename $(3))) boards/$(folder)/board.ld
	@echo "  ld $$@"
	$(Q)$($(1)_tools)gcc $($(1)_cpu) -o $$@ $$(filter %.o,$$^) -T boards/$(folder)/board.ld \
	    $(bare_link) -Wl,-Map=$$(@:.elf=.map)
endef

# bare_objects BOARD: how its sources are compiled, and the scenes of the tests.
define bare_objects
$(call bare_program,$(1),scenes-$(1),$(device_src) $($(1)_hal) tests/chip/scenes.c \
    tests/chip/main_$(folder).c tests/chip/trees.S)
$(O)/$(1)/flags $(O)/$(1)/boards/flags: FORCE
	@mkdir -p $$(@D)
	@echo '$$(said)' | cmp -s - $$@ || echo '$$(said)' >$$@
$(O)/$(1)/flags: said = $($(1)_cpu) $(bare_flags)
$(O)/$(1)/boards/flags: said = $($(1)_board) $(TREE)
$(O)/$(1)/boards/$(folder)/main.o $(O)/$(1)/boards/$(folder)/tree.o: $(O)/$(1)/boards/flags
$(O)/$(1)/boards/$(folder)/main.o: board_flags = $($(1)_board)
$(O)/$(1)/%.o: %.c $(O)/$(1)/flags
	@mkdir -p $$(@D)
	@echo "  cc $$< ($(1))"
	$(Q)$($(1)_tools)gcc $(bare_flags) $($(1)_cpu) $$(board_flags) -fstack-usage -MMD -MP -c -o $$@ $$<
$(O)/$(1)/%.o: %.S $(O)/$(1)/flags
	@mkdir -p $$(@D)
	@echo "  as $$< ($(1))"
	$(Q)$($(1)_tools)gcc $($(1)_cpu) -g -DTREE='"$(TREE)"' -DFLAT_TREE='"$(O)/chip/oldwell.owt$($(1)_spread)"' \
	    -DSMOOTH_TREE='"$(O)/chip/smooth.owt$($(1)_spread)"' -c -o $$@ $$<
$(O)/$(1)/boards/$(folder)/tree.o: $(TREE)
$(O)/$(1)/tests/chip/trees.o: $(patsubst %,$(O)/chip/%.owt$($(1)_spread),oldwell smooth)
endef

# bare_board BOARD: its program.
define bare_board
$(call bare_objects,$(1))
.PHONY: board-$(1)
board-$(1): $(O)/oldwell-$(1).elf $(O)/oldwell-$(1).bin
$(call bare_program,$(1),oldwell-$(1),$(device_src) $($(1)_hal) boards/$(folder)/main.c boards/$(folder)/tree.S)
$(O)/oldwell-$(1).bin: $(O)/oldwell-$(1).elf
	$(Q)$($(1)_tools)objcopy -O binary $$< $$@
endef
# The core alone, linked as the least of viewers would.
$(foreach v,lm3s6965evb lm3s6965evb-planes,$(eval $(call bare_program,$(v),size-$(v), \
    $(wildcard firmware/core/*.c) hal/bare/memory.c tests/chip/main_size.c \
    boards/lm3s6965evb/tree.S)))
$(eval $(call bare_objects,lm3s6965evb-planes))
.PHONY: size size-programs
size-programs: $(O)/size-lm3s6965evb.elf $(O)/size-lm3s6965evb-planes.elf $(foreach b,lm3s6965evb raspi2b,$(O)/oldwell-$(b).elf)
size: ## flash and RAM of the core and the boards, part by part
	@scripts/setup demo chip
	$(submake) size-programs
	@scripts/size "$(O)"
$(foreach b,$(bare_boards),$(eval $(call bare_board,$(b))))
-include $(shell find $(foreach b,$(bare_boards) lm3s6965evb-planes,$(O)/$(b)) -name '*.d' 2>/dev/null)

.PHONY: board run image flash
ifneq ($(filter $(BOARD),$(bare_boards)),)
all: board
board: board-$(BOARD)
run: board
	$($(BOARD)_qemu) -kernel $(O)/oldwell-$(BOARD).elf -serial mon:stdio
image: board
flash:
	@echo "make: no programmer is known for $(BOARD); write $(O)/oldwell-$(BOARD).bin to" \
	    "address 0 of its flash with yours" >&2; exit 2
else
ifneq ($(BOARD),sim)
all programs: no-board
.PHONY: no-board
no-board:
	@echo "make: there is no BOARD=$(BOARD); there are sim $(bare_boards)" >&2; exit 2
endif
run image flash:
	@echo "make: $@ wants a board: make BOARD=NAME $@, of $(bare_boards)" >&2; exit 2
endif

# What the tests of the boards use on the host.
.PHONY: chip-tools
chip-tools: $(O)/tests/panel_dump $(O)/tests/read_message $(O)/tests/scenes $(O)/tests/spread \
            $(O)/chip/smooth.owt
$(O)/tests/spread: $(O)/obj/tests/chip/spread.o
$(O)/tests/panel_dump: $(O)/obj/tests/chip/panel_dump.o
$(O)/tests/read_message: $(O)/obj/tests/chip/read_message.o $(O)/obj/firmware/device/font.o
$(O)/tests/scenes: $(call obj,tests/chip/scenes.c tests/chip/main_host.c \
                    $(wildcard firmware/viewer/*.c)) $(O)/core.a
$(O)/tests/panel_dump $(O)/tests/read_message $(O)/tests/scenes $(O)/tests/spread:
	@mkdir -p $(@D)
	@echo "  ld $@"
	$(Q)$(link_program)

# Instructions a frame on a Cortex-M3: exact, so no pass is repeated.
.PHONY: bench-chip
bench: bench-chip
bench-chip: chip-tools ## the part of make bench that counts a Cortex-M3's instructions in QEMU
	@scripts/setup chip
	@scripts/bench-chip "$(O)"
