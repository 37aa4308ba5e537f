# tribox.h needs no build: copy the header. This file builds its tests, benches and examples, with GNU make.
# `make help` lists the targets; each folder's own rules stand in its .mk file.

CC     ?= cc
CXX    ?= c++
CFLAGS ?= -O2
PREFIX ?= /usr/local
B      := build

WARN   := -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wundef -Wcast-qual -Wdouble-promotion
WARN_C := $(WARN) -Wstrict-prototypes -Wmissing-prototypes
ifdef werror
WARN   += -Werror
endif
CC_C99 = $(CC) -std=c99 -I. $(WARN_C) $(CFLAGS)

all: build-tests build-examples ## build tests and examples into build/, run nothing
.DEFAULT_GOAL := all
.PHONY: all help clean install uninstall

include examples/examples.mk
include examples/web/web.mk
include tests/tests.mk
include tests/check.mk
include bench/bench.mk
include tests/peers/peers.mk

# include/tribox.h, a pkg-config file, and the programs voxelize and check_voxels. DESTDIR is put before PREFIX, for
# packagers.
BINDIR       ?= $(PREFIX)/bin
INCLUDEDIR   ?= $(PREFIX)/include
PKGCONFIGDIR ?= $(PREFIX)/share/pkgconfig
VERSION       = $(shell awk '/^.define TRIBOX_VERSION_(MAJOR|MINOR|PATCH) / { printf "%s%s", dot, $$3; dot = "." }' tribox.h)

install: $(B)/voxelize $(B)/check_voxels ## copy tribox.h, tribox.pc, voxelize and check_voxels below PREFIX (and DESTDIR)
	install -d '$(DESTDIR)$(INCLUDEDIR)' '$(DESTDIR)$(PKGCONFIGDIR)' '$(DESTDIR)$(BINDIR)'
	install -m 755 $(B)/voxelize $(B)/check_voxels '$(DESTDIR)$(BINDIR)'
	install -m 644 tribox.h '$(DESTDIR)$(INCLUDEDIR)/tribox.h'
	printf '%s\n' 'Name: tribox' 'Description: Exact triangle / axis-aligned box overlap tests in one C header' \
	    'Version: $(VERSION)' 'Cflags: -I$(INCLUDEDIR)' > '$(DESTDIR)$(PKGCONFIGDIR)/tribox.pc'
	chmod 644 '$(DESTDIR)$(PKGCONFIGDIR)/tribox.pc'

uninstall: ## remove what install copied
	rm -f '$(DESTDIR)$(INCLUDEDIR)/tribox.h' '$(DESTDIR)$(PKGCONFIGDIR)/tribox.pc'
	rm -f '$(DESTDIR)$(BINDIR)/voxelize' '$(DESTDIR)$(BINDIR)/check_voxels'

help: ## list the targets
	@echo 'tribox.h $(VERSION): copy the header, or choose a target.'
	@for list in $(MAKEFILE_LIST); do \
	    echo; echo "$$list"; \
	    sed -nE 's/^([a-z-]+):.*## (.*)/  make \1\t\2/p' $$list | expand -t 24; \
	done
	@echo
	@echo 'Variables, with what they are now:'
	@echo '  CC=$(CC) CXX=$(CXX) CFLAGS="$(CFLAGS)"'
	@echo '  PREFIX=$(PREFIX) DESTDIR=$(DESTDIR)    where install goes'
	@echo '  werror=1                      warnings are errors'
	@echo '  CSV=file                      bench: write the figures there too'
	@echo '  VERIFY_THOUSANDS=$(VERIFY_THOUSANDS) FUZZ_SECONDS=$(FUZZ_SECONDS)    verify, fuzz: how much'

clean: ## remove build/
	rm -rf $(B)
