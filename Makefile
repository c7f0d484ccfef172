# SPDX-License-Identifier: 0BSD
# Oldwell's build: GNU make 4.3, not recursive inside one configuration.
# Another configuration is another folder: make O=build/clang CC=clang ; make O=build/asan SAN=1
# `make help` lists the targets.

O       ?= build
prefix  ?= /usr/local
CFLAGS  ?= -O2 -g
JOBS    ?= $(shell nproc 2>/dev/null || echo 1)
BOARD   ?= sim
export O CC WERROR

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules
Q := $(if $(V),,@)

warnings := -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Wstrict-prototypes -Wmissing-prototypes
ifeq ($(WERROR),1)
warnings += -Werror
endif
ifeq ($(SAN),1)
sanitize := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
endif

# Packages that could not be installed without an upgrade were unpacked here by scripts/setup.
private := $(wildcard build/packages/usr)
ifneq ($(private),)
triplet := $(shell $(CC) -print-multiarch 2>/dev/null)
private_cflags := -isystem $(private)/include
private_ldflags := -L$(private)/lib/$(triplet) -Wl,-rpath,$(abspath $(private)/lib/$(triplet))
export PKG_CONFIG_PATH := $(abspath $(private)/lib/$(triplet)/pkgconfig):$(PKG_CONFIG_PATH)
endif

PKG_CONFIG ?= pkg-config
pkg         = $(shell $(PKG_CONFIG) $(1) $(2) 2>/dev/null)
core_flags  = -std=c11 -ffreestanding $(CFLAGS) $(warnings) $(sanitize) -I. -Ifirmware/core
host_flags  = -std=c11 -D_POSIX_C_SOURCE=200809L -ffp-contract=off $(CFLAGS) $(warnings) $(sanitize) \
              -I. -Ifirmware/core $(private_cflags)
link        = $(CC) $(CFLAGS) $(sanitize) $(LDFLAGS) $(private_ldflags)

# ---- sources, by folder -------------------------------------------------------------------------
core_src   := $(wildcard firmware/core/*.c)
owsim_src  := $(wildcard firmware/viewer/*.c firmware/device/*.c hal/panel/*.c sim/*.c boards/sim/*.c)
common_src := $(wildcard tools/common/*.c)
owgen_src  := $(wildcard tools/owgen/*.c)
owc_src    := $(wildcard tools/owc/*.c)
owbench_src := $(wildcard tools/owbench/*.c)
oracle_src := $(wildcard tests/oracle/*.c)
test_src   := $(wildcard tests/unit/test_*.c tests/property/test_*.c tests/fault/test_*.c)
helper_src := $(filter-out $(test_src),$(wildcard tests/unit/*.c tests/property/*.c tests/fault/*.c \
                tests/common/*.c))
fuzz_src   := $(wildcard tests/fuzz/fuzz_*.c)
helper_src += $(filter-out $(fuzz_src) tests/fuzz/replay.c,$(wildcard tests/fuzz/*.c))

obj   = $(patsubst %.c,$(O)/obj/%.o,$(1))
parts = $(call obj,$(filter-out %/main.c,$(1)))
mains = $(call obj,$(filter %/main.c,$(1)))

tests := $(patsubst %.c,$(O)/tests/%,$(notdir $(test_src)))
fuzzers := $(patsubst %.c,%,$(notdir $(fuzz_src)))
# Kept although only pattern rules name them. (All others must not be secondary: make would not
# miss them.)
.SECONDARY: $(call obj,$(fuzz_src))

# ---- programs -----------------------------------------------------------------------------------
.PHONY: all programs tests replay fuzzers
all: programs
programs: $(O)/owgen $(O)/owc $(O)/owsim $(O)/owbench

# With LAUNCH (an emulator, say) a program is the file NAME.elf and a script NAME that starts it.
define finish
$(if $(LAUNCH),mv $@ $@.elf && printf '#!/bin/sh\nexec $(LAUNCH) "%s" "$$@"\n' \
	    '$(abspath $@).elf' >$@ && chmod +x $@)
endef
link_program = $(link) -o $@ $(filter %.o,$^) -Wl,--start-group $(filter %.a,$^) \
               -Wl,--end-group

png_libs    = $(call pkg,--libs,libpng) -lgif -pthread
assimp_libs = $(call pkg,--libs,assimp)
json_libs   = $(call pkg,--libs,libcjson)
test_libs   = $(call pkg,--libs,cmocka) $(png_libs) $(assimp_libs) $(json_libs) -lm

$(O)/owgen: $(call mains,$(owgen_src)) $(O)/owgen.a $(O)/common.a
	@echo "  ld $@"
	$(Q)$(link_program) -lm
	$(Q)$(finish)
$(O)/owc: $(call mains,$(owc_src)) $(O)/owc.a $(O)/common.a $(O)/core.a
	@echo "  ld $@"
	$(Q)$(link_program) $(assimp_libs) $(json_libs) -lm
	$(Q)$(finish)
$(O)/owsim: $(call mains,$(owsim_src)) $(O)/owsim.a $(O)/common.a $(O)/core.a
	@echo "  ld $@"
	$(Q)$(link_program) $(png_libs) $(json_libs) -lm
	$(Q)$(finish)

$(O)/owbench: $(call obj,$(owbench_src)) $(O)/common.a
	@echo "  ld $@"
	$(Q)$(link_program) $(json_libs) -lm
	$(Q)$(finish)

$(O)/core.a: $(call parts,$(core_src))
$(O)/owsim.a: $(call parts,$(owsim_src))
$(O)/common.a: $(call parts,$(common_src))
$(O)/owgen.a: $(call parts,$(owgen_src))
$(O)/owc.a: $(call parts,$(owc_src))
$(O)/oracle.a: $(call parts,$(oracle_src))
$(O)/helpers.a: $(call parts,$(helper_src))
$(O)/%.a:
	@mkdir -p $(@D)
	@rm -f $@
	@$(AR) rcs $@ $(filter %.o,$^)

# ---- tests --------------------------------------------------------------------------------------
archives := $(foreach a,helpers oracle owc owgen owsim oldwell common core,$(O)/$(a).a)

tests: $(tests) $(if $(oracle_src),$(O)/tests/oracle)
replay: $(fuzzers:%=$(O)/tests/replay_%)
fuzzers: $(fuzzers:%=$(O)/%)

# owgen and owc are two programs, each with names of its own: a test links with one of them.
other_program = $(O)/$(if $(shell grep -l '"tools/owgen/' $(1)),owc,owgen).a
define test_program
$(O)/tests/$(basename $(notdir $(1))): $(call obj,$(1)) \
        $(filter-out $(call other_program,$(1)),$(archives)) | have-cmocka
	@mkdir -p $$(@D)
	@echo "  ld $$@"
	$(Q)$$(link_program) $$(test_libs)
	$(Q)$$(finish)
endef
$(foreach t,$(test_src),$(eval $(call test_program,$(t))))

$(O)/tests/oracle: $(call mains,$(oracle_src)) $(archives)
	@mkdir -p $(@D)
	@echo "  ld $@"
	$(Q)$(link_program) $(png_libs) $(assimp_libs) $(json_libs) -lm
	$(Q)$(finish)
$(O)/tests/replay_%: $(O)/obj/tests/fuzz/%.o $(O)/obj/tests/fuzz/replay.o $(archives)
	@mkdir -p $(@D)
	@echo "  ld $@"
	$(Q)$(link_program) $(png_libs) $(assimp_libs) $(json_libs) -lm
	$(Q)$(finish)
$(O)/fuzz_%: $(O)/obj/tests/fuzz/fuzz_%.o $(archives)
	@echo "  ld $@"
	$(Q)$(link_program) -fsanitize=fuzzer $(png_libs) $(assimp_libs) $(json_libs) -lm

# ---- objects ------------------------------------------------------------------------------------
# Every object is made again when the compiler or its flags change.
flags := $(CC) $(CFLAGS) $(warnings) $(sanitize) $(private_cflags) $(LAUNCH)
$(O)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(flags)' | cmp -s - $@ || echo '$(flags)' >$@

$(O)/obj/firmware/core/%.o: firmware/core/%.c $(O)/flags
	@mkdir -p $(@D)
	@echo "  cc $<"
	$(Q)$(CC) $(core_flags) -fstack-usage -MMD -MP -c -o $@ $<
$(O)/obj/%.o: %.c $(O)/flags
	@mkdir -p $(@D)
	@echo "  cc $<"
	$(Q)$(CC) $(host_flags) $(extra) -MMD -MP -c -o $@ $<

$(O)/obj/tools/owc/%.o: extra = $(call pkg,--cflags,assimp) $(call pkg,--cflags,libcjson)
$(O)/obj/sim/%.o: extra = $(call pkg,--cflags,libpng)
$(O)/obj/tools/owbench/%.o $(O)/obj/tools/common/%.o: extra = $(call pkg,--cflags,libcjson)
$(O)/obj/boards/sim/%.o $(O)/obj/tests/%.o: extra = $(call pkg,--cflags,libpng libcjson)
$(call obj,$(owc_src)): | have-assimp
$(call obj,$(filter sim/%,$(owsim_src))): | have-libpng

.PHONY: have-%
have-%:
	@$(PKG_CONFIG) --exists $* || \
	    { echo "make: the library $* is not there: run scripts/setup check" >&2; exit 1; }

-include $(shell find $(O)/obj -name '*.d' 2>/dev/null)

# ---- what people run ----------------------------------------------------------------------------
submake = @+$(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,-j$(JOBS))

.PHONY: help demo check check-all check-rest format golden-update fuzz install clean FORCE
help: ## show this list
	@grep -hE '^[a-z-]+:.*## ' Makefile mk/*.mk | sort | \
	    while IFS= read -r l; do printf '  make %-14s%s\n' "$${l%%:*}" "$${l#*## }"; done
	@echo '  make                build/owgen, build/owc, build/owsim and build/owbench'
	@echo '  make BOARD=NAME     a program for a board without an operating system: $(bare_boards)'
	@echo '  make BOARD=NAME run shows it in QEMU; TREE=FILE.owt: another tree than the Old Well'
	@echo 'Variables: O=folder CC=compiler CFLAGS=... SAN=1 (sanitizers) WERROR=1 STRICT=1 V=1'

demo: ## the Old Well in one turn: pictures in build/demo
	@scripts/setup demo
	$(submake) programs
	@scripts/demo

check: ## every native test; installs what is missing for it
	@scripts/setup check
	@scripts/suites check

check-all: ## check, then other compilers, levels and machines, and lint
	@scripts/setup check cross lint
	@scripts/suites all

check-rest: ## what check-all does beyond check
	@scripts/setup check cross lint
	@scripts/suites rest

format: ## clang-format over all C files
	@scripts/setup lint
	find . -name build -prune -o -name '*.[ch]' -print | xargs clang-format -i

golden-update: ## write the golden files anew (look at the difference before you keep it)
	@scripts/setup check
	$(submake) programs tests
	@scripts/suites golden-update

fuzz: ## libFuzzer on every target, FUZZ_SECONDS each (600); FUZZ_SCENES trees (1000000)
	@scripts/setup check cross
	$(submake) $(O)/tests/test_order
	$(submake) O=build/fuzz CC=clang \
	    CFLAGS='-O1 -g -fsanitize=fuzzer-no-link' SAN=1 fuzzers
	@scripts/fuzz

install: programs ## owgen, owc and owsim into DESTDIR/prefix/bin
	install -d $(DESTDIR)$(prefix)/bin
	install -m 755 $(O)/owgen $(O)/owc $(O)/owsim $(DESTDIR)$(prefix)/bin

clean: ## remove what was built, packages fetched for other machines excepted
	rm -rf $(O)/obj $(O)/tests $(O)/*.a $(O)/owgen $(O)/owc $(O)/owsim $(O)/owbench

.PHONY: bench
bench: programs ## the orders, shades and threads side by side (minutes)
	@scripts/bench

# Targets of the chip boards and the Linux boards, a file each.
include $(wildcard mk/*.mk)
