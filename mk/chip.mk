# SPDX-License-Identifier: 0BSD
# Boards with a microcontroller, and what they take.
.PHONY: size run image flash
size run image flash:
	@echo "make: $@ is not there yet" >&2; exit 2
ifneq ($(BOARD),sim)
all programs: no-board
.PHONY: no-board
no-board:
	@echo "make: BOARD=$(BOARD) is not there yet; there is BOARD=sim" >&2; exit 2
endif
