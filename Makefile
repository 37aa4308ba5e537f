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
.PHONY: all help clean install

include examples/examples.mk
include tests/tests.mk
include tests/check.mk
include bench/bench.mk

help: ## list the targets
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sort | sed -E 's/^([a-z-]+):.*## /  make \1\t/' | expand -t 24
	@echo '  variables: CC CXX CFLAGS PREFIX werror=1'

clean: ## remove build/
	rm -rf $(B)
