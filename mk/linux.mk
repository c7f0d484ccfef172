# SPDX-License-Identifier: 0BSD
# Linux boards: the program oldwell and its tests in a guest.
# STATIC=1 links it without shared libraries, as a guest's or a rescue system's root wants it.
# DRM=no leaves out displays by libdrm; by itself it is left out where libdrm is missing.

ifneq ($(STATIC),)
pkg_sysroot = $(patsubst --sysroot=%,%,$(filter --sysroot=%,$(CC)))
endif
DRM ?= $(if $(pkg_sysroot)$(shell $(PKG_CONFIG) --exists libdrm 2>/dev/null && echo yes),yes,no)
ifeq ($(DRM),yes)
drm_cflags := -DOLDWELL_DRM -isystem $(pkg_sysroot)/usr/include/libdrm
drm_libs   := $(if $(pkg_sysroot),-ldrm -lm,$(call pkg,--libs,libdrm))
else
without_drm := hal/linux/drm.c hal/linux/drm_calls.c hal/linux/drm_screen.c \
               boards/linux/output_drm.c
endif

# libgpiod has two interfaces; GPIOD=v1, v2 or none says which, by itself the installed one.
gpiod_pkg := $(if $(pkg_sysroot),PKG_CONFIG_LIBDIR=$(firstword \
    $(wildcard $(pkg_sysroot)/usr/lib/*/pkgconfig))) $(PKG_CONFIG)
GPIOD ?= $(shell if $(gpiod_pkg) --atleast-version=2 libgpiod 2>/dev/null; then echo v2; \
    elif $(gpiod_pkg) --exists libgpiod 2>/dev/null; then echo v1; else echo none; fi)
gpiod_libs ?= $(if $(filter-out none,$(GPIOD)),-lgpiod)
without_gpiod := $(filter-out hal/linux/gpiod_$(GPIOD).c,$(wildcard hal/linux/gpiod_*.c))

linux_src  := $(filter-out $(without_drm) $(without_gpiod), \
                $(wildcard hal/linux/*.c boards/linux/*.c))
viewer_src := $(wildcard firmware/viewer/*.c hal/panel/*.c)

$(O)/oldwell.a: $(call parts,$(linux_src) $(viewer_src))
$(O)/oldwell: $(call mains,$(linux_src)) $(O)/oldwell.a $(O)/common.a $(O)/core.a
	@echo "  ld $@"
	$(Q)$(link_program) $(if $(STATIC),-static) $(drm_libs) $(gpiod_libs) -lm
	$(Q)$(finish)
$(O)/obj/tests/unit/test_linux_drm.o: extra = $(drm_cflags)
$(O)/obj/boards/linux/%.o $(O)/obj/hal/linux/%.o: extra = $(drm_cflags) $(gpiod_cflags) \
    -DOLDWELL_DATA_DIR='"$(prefix)/share/oldwell"'
$(O)/obj/boards/linux/settings.o: $(O)/data-dir
$(O)/data-dir: FORCE
	@mkdir -p $(@D)
	@echo '$(prefix)' | cmp -s - $@ || echo '$(prefix)' >$@
test_libs += $(drm_libs) $(gpiod_libs)

programs: $(O)/oldwell

.PHONY: linux-arm64
linux-arm64: ## oldwell for arm64 boards, without shared libraries: build/linux-arm64/oldwell
	@scripts/setup cross
	@scripts/arm64-root
	@+$(MAKE) --no-print-directory O=build/linux-arm64 STATIC=1 \
	    CC='aarch64-linux-gnu-gcc --sysroot=$(CURDIR)/build/arm64-root' \
	    build/linux-arm64/oldwell

# ---- to install ---------------------------------------------------------------------------------
# oldwell.service is not enabled and no group is made here: the package manager or the
# administrator does (systemctl enable, systemd-sysusers, udevadm control --reload).
bindir   ?= $(prefix)/bin
datadir  ?= $(prefix)/share
libdir   ?= $(prefix)/lib
linux_boards := $(patsubst boards/%/board.conf,%,$(wildcard boards/*/board.conf))

$(O)/oldwell.owt: $(O)/owgen $(O)/owc
	$(Q)$(O)/owgen oldwell --detail high -o $(O)/oldwell.obj
	$(Q)$(O)/owc $(O)/oldwell.obj -o $@

install: install-linux
.PHONY: install-linux install-linux-files
install-linux: $(O)/oldwell $(O)/oldwell.owt
	@+$(MAKE) --no-print-directory install-linux-files
install-linux-files:
	install -d $(DESTDIR)$(bindir) $(DESTDIR)$(datadir)/man/man1 $(DESTDIR)$(datadir)/man/man5 \
	    $(DESTDIR)$(datadir)/oldwell $(DESTDIR)$(libdir)/systemd/system \
	    $(DESTDIR)$(libdir)/sysusers.d $(DESTDIR)$(libdir)/udev/rules.d
	install -m 755 $(O)/oldwell $(DESTDIR)$(bindir)
	install -m 644 docs/man/oldwell.1 $(DESTDIR)$(datadir)/man/man1
	install -m 644 docs/man/oldwell-board.5 $(DESTDIR)$(datadir)/man/man5
	install -m 644 $(O)/oldwell.owt packaging/console.conf $(DESTDIR)$(datadir)/oldwell
	for b in $(linux_boards); do \
	    install -d $(DESTDIR)$(datadir)/oldwell/boards/$$b && \
	    install -m 644 boards/$$b/board.conf boards/$$b/README.md \
	        $(DESTDIR)$(datadir)/oldwell/boards/$$b || exit 1; done
	sed 's|@bindir@|$(bindir)|' packaging/oldwell.service.in \
	    >$(DESTDIR)$(libdir)/systemd/system/oldwell.service
	chmod 644 $(DESTDIR)$(libdir)/systemd/system/oldwell.service
	install -m 644 packaging/sysusers.conf $(DESTDIR)$(libdir)/sysusers.d/oldwell.conf
	install -m 644 packaging/udev.rules $(DESTDIR)$(libdir)/udev/rules.d/70-oldwell.rules
