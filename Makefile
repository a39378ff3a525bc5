# Kirsch: how brittle plates with holes break.
#
#   make            build everything into build/
#   make demo       a crack runs through a porous plate; ends with pictures (FULL=1: the paper's size)
#   make study      run the example study of random pores; goes on where it was interrupted
#   make test       all tests (ONLY=word: those whose name contains the word)
#   make fuzz       damaged files for every reader, under AFL++ (FUZZ_SECONDS= each, KINDS=)
#   make sanitize   small cases under valgrind, and the leak and thread sanitizers (WITH=)
#   make allocations  each allocation of each program fails in turn (some 15 minutes)
#   make bench      measure the speed; writes build/bench.csv
#   make bench-growth  the speed by nodes, m and threads; what mixed precision changes; large meshes
#   make deps       list what the system lacks and install it (Debian; sudo where not root)
#   make corrections  write docs/corrections.md anew: all partial volumes with all surface corrections
#   make sbom       list what is linked, as SPDX (build/kirsch.spdx)
#   make pores-500  mesh 500 random fields of 30 pores (GRID=, SEEDS=, PORES=, SPACING= in mm)
#   make bar        a bar of cubes, pulled, with each surface correction
#   make cases/NAME run a case that is compared with something known (FULL=1: the published size)
#   make validate   run all of them, small; writes build/validation.csv
#   make oracle     what development checks against PETSc and VTK, where they are installed
#   make equilibrium  measure the static solver at three sizes, up to 780 000 nodes
#   make free-grid  measure the free grid at three sizes (the table in docs/grids.md)
#   make bench-read time the reader of gmsh's meshes
#   make bench-tree time crack tracking and maps for 780 000 nodes
#   make pictures   make the pictures of the documentation anew, from the demo
#   make node-order  time the loop over bonds with nodes in rows, by METIS, along curves, ...
#   make lloyd-solid  measure what Lloyd's steps would gain in space (a table in docs/grids.md)
#   make soak       leave a run alone for two hours (HOURS=), and ask what became of it
#   make docs       write docs/deck.md anew from the table that reads the deck
#   make format     clang-format the sources
#   make install    PREFIX=/usr/local
#   make clean
#   make help       this list
#
# Settings: CC, CXX, CFLAGS, PREFIX, V=1 (show commands), SANITIZE=1 (address and undefined behaviour).
# Sources are found by wildcard: a new file needs no change here. A file named kirsch-*.c is a program.

MAKEFLAGS += --no-builtin-rules
BUILD    ?= build
PREFIX   ?= /usr/local
CC       ?= cc
CXX      ?= c++
CFLAGS   ?= -O2 -g
Q        := $(if $(V),,@)

WARNINGS := -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes \
            -Wno-missing-field-initializers
# Results made by another version are out of date, so that tables written into cases/*/README.md must not make one.
VERSION  := $(shell git describe --always --tags 2>/dev/null || echo unknown)$(shell \
              git diff --quiet HEAD -- Makefile pre solver post 2>/dev/null; [ $$? -ne 1 ] || echo -dirty)
# The bond loop is worth -O3, but not the minutes that the sanitizers make of it.
KERNEL_FLAGS = $(if $(SANITIZE),-O1,-O3)
ifdef SANITIZE
CFLAGS   += -fsanitize=address,undefined -fno-omit-frame-pointer
endif
# What makes a fault hard to use: canaries, checked copies, addresses that move, tables that are read-only.
# docs/reliability.md has the cost; HARDEN= and HARDEN_LINK= build without.
HARDEN      ?= $(if $(SANITIZE),,-fstack-protector-strong -D_FORTIFY_SOURCE=2) -fPIE
HARDEN_LINK ?= -pie -Wl,-z,relro,-z,now
ALL_FLAGS = -std=c11 -D_GNU_SOURCE -fopenmp $(WARNINGS) $(CFLAGS) $(HARDEN) -Isolver -Ipre -Ipost -MMD -MP \
            $(shell pkg-config --cflags hdf5 libfyaml udunits 2>/dev/null)
# CGAL stands in one file (pre/cgal_surface.cpp), which takes half a minute to compile.
CXX_FLAGS = -std=c++17 -Wall -Wextra $(CFLAGS) $(HARDEN) -Ipre -MMD -MP
CGAL_LIBS = -lstdc++ -lgmp -lmpfr
LIBS      = $(HARDEN_LINK) $(shell pkg-config --libs hdf5 libfyaml 2>/dev/null) -ludunits2 -lmuparser -lm

# What Debian must provide to build and run, and to test.
PACKAGES := pkg-config libhdf5-dev libfyaml-dev libudunits2-dev libmuparser-dev libgmsh-dev \
            libmetis-dev libcmocka-dev python3 python3-numpy python3-matplotlib python3-h5py \
            ffmpeg python3-meshio python3-netcdf4 gmsh g++ libcgal-dev

# What cases/ compare with.
CASES_PACKAGES := calculix-ccx

programs_c := $(wildcard pre/kirsch-*.c solver/kirsch-*.c post/kirsch-*.c) $(wildcard solver/kirsch.c)
library_c  := $(filter-out $(programs_c) solver/kernel.c,$(wildcard solver/base/*.c solver/*.c \
              solver/material/*.c pre/*.c post/*.c))
programs   := $(patsubst %.c,$(BUILD)/%,$(notdir $(programs_c)))
library_o  := $(patsubst %.c,$(BUILD)/%.o,$(library_c)) $(BUILD)/pre/cgal_surface.o
tests_c    := $(wildcard tests/unit/*.c tests/property/*.c tests/convergence/*.c tests/input/*.c)
cases      := $(patsubst %/run,%,$(wildcard cases/*/run))
tests      := $(patsubst tests/%.c,$(BUILD)/tests/%,$(tests_c))
scripts    := $(patsubst %,$(BUILD)/%,$(notdir $(wildcard pre/*.py post/*.py)))

# The bond loop is built once for each kind of processor and chosen at run time.
kernels    := $(if $(wildcard solver/kernel.c),baseline $(if $(filter x86_64,$(shell uname -m)),avx2 avx512))
kernel_o   := $(foreach k,$(kernels),$(BUILD)/solver/kernel_$(k).o $(BUILD)/solver/kernel_$(k)_mixed.o)
KERNEL_baseline :=
KERNEL_avx2     := -march=x86-64-v3
KERNEL_avx512   := -march=x86-64-v4 -mprefer-vector-width=512
$(foreach k,$(kernels),$(eval KERNEL_$(k)_mixed := $(KERNEL_$(k)) -DKR_FLOAT))

.PHONY: FORCE all help demo study test fuzz sanitize allocations oracle bench bench-growth bench-read bench-tree pictures node-order deps \
        corrections pores-500 equilibrium free-grid lloyd-solid bar soak validate $(cases) \
        docs format install clean check-deps sbom
all: check-deps $(programs) $(scripts)

help:
	@sed -n '2,/^$$/s/^# \{0,1\}//p' Makefile | sed '/^Settings/,$$d'

# ---- what the system must have --------------------------------------------------------------
check-deps:
	@tests/deps check $(PACKAGES)

deps:
	@tests/deps install $(PACKAGES)

# The version is compiled into one file only; it is built anew when the version changes.
$(BUILD)/solver/base/provenance.o: $(BUILD)/version
$(BUILD)/version: FORCE
	@mkdir -p $(@D)
	@echo '$(VERSION)' | cmp -s - $@ || echo '$(VERSION)' > $@
FORCE:

# ---- building -------------------------------------------------------------------------------
$(BUILD)/libkirsch.a: $(library_o) $(kernel_o)
	$(Q)rm -f $@ && ar rcs $@ $^

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	@echo "  cc    $<"
	$(Q)$(CC) $(ALL_FLAGS) -DKR_VERSION='"$(VERSION)"' -c $< -o $@

$(BUILD)/%.o: %.cpp
	@mkdir -p $(@D)
	@echo "  c++   $<"
	$(Q)$(CXX) $(CXX_FLAGS) -c $< -o $@

$(BUILD)/%.py: post/%.py
	@mkdir -p $(@D)
	$(Q)cp $< $@

$(BUILD)/%.py: pre/%.py
	@mkdir -p $(@D)
	$(Q)cp $< $@

$(BUILD)/solver/kernel_%.o: solver/kernel.c
	@mkdir -p $(@D)
	@echo "  cc    $< ($*)"
	$(Q)$(CC) $(ALL_FLAGS) $(KERNEL_FLAGS) $(KERNEL_$*) -ffp-contract=fast -DKR_KERNEL=kr_kernel_$* -DKR_KERNEL_NAME='"$*"' -c $< -o $@

define program_rule
$(BUILD)/$(basename $(notdir $(1))): $(BUILD)/$(basename $(1)).o $(BUILD)/libkirsch.a
	@echo "  link  $$(@F)"
	$$(Q)$(CC) $$(CFLAGS) -fopenmp $$< $(BUILD)/libkirsch.a $$(if $$(findstring gmsh,$$(@F)),-lgmsh) $$(if $$(findstring nodes,$$(@F)),-lmetis) $$(if $$(findstring mesh,$$(@F)),$(CGAL_LIBS)) $$(LIBS) -o $$@
endef
$(foreach c,$(programs_c),$(eval $(call program_rule,$(c))))

$(BUILD)/tests/%: tests/%.c tests/test.h $(BUILD)/libkirsch.a
	@mkdir -p $(@D)
	@echo "  test  $<"
	$(Q)$(CC) $(ALL_FLAGS) -Itests $< $(BUILD)/libkirsch.a $(LIBS) -lmetis -lcmocka -Wl,--as-needed $(CGAL_LIBS) -o $@

# What the fuzzer starts, built by its compiler into a folder of its own (make fuzz).
$(BUILD)/feed: tests/fuzz/feed.c tests/readers.h $(BUILD)/libkirsch.a
	$(Q)$(CC) $(ALL_FLAGS) -Itests $< $(BUILD)/libkirsch.a $(LIBS) -Wl,--wrap=exit,--wrap=kr_seal_holds -o $@

$(BUILD)/fields: $(BUILD)/cases/pores-500/fields.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

$(BUILD)/lloyd: $(BUILD)/cases/lloyd-solid/lloyd.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -Wl,--as-needed $(CGAL_LIBS) -o $@

$(BUILD)/corrections: $(BUILD)/cases/corrections/corrections.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

$(BUILD)/read: $(BUILD)/cases/bench/read.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

$(BUILD)/order: $(BUILD)/cases/node-order/order.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

$(BUILD)/bar: $(BUILD)/cases/bar/bar.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

$(BUILD)/plain: $(BUILD)/cases/equilibrium/plain.o $(BUILD)/libkirsch.a
	@echo "  link  $(@F)"
	$(Q)$(CC) $(CFLAGS) -fopenmp $^ $(LIBS) -o $@

# Against PETSc, which brings an MPI of its own: a program of its own, no part of the tests.
ORACLE_FLAGS = $(filter-out -D%,$(subst -I,-isystem ,$(shell pkg-config --cflags petsc)))
$(BUILD)/tests/oracle/petsc: tests/oracle/petsc.c tests/test.h $(BUILD)/libkirsch.a
	@mkdir -p $(@D)
	@echo "  test  $<"
	$(Q)$(CC) $(ALL_FLAGS) -Itests $(ORACLE_FLAGS) $< $(BUILD)/libkirsch.a $(LIBS) \
	    $(shell pkg-config --libs petsc) -lcmocka -o $@

# ---- running --------------------------------------------------------------------------------
demo: deps
	@$(MAKE) --no-print-directory all
	@$(BUILD)/kirsch cases/demo/case.yaml $(if $(FULL),--variant full)

study: deps
	@$(MAKE) --no-print-directory all
	@$(BUILD)/kirsch-study cases/study/study.yaml

test: deps
	@$(MAKE) --no-print-directory all $(tests)
	@BUILD=$(BUILD) ONLY='$(ONLY)' tests/run

fuzz: deps
	@tests/deps install afl++ clang libomp-dev
	@$(MAKE) --no-print-directory all
	@AFL_QUIET=1 $(MAKE) --no-print-directory BUILD=$(BUILD)/fuzz CC=afl-clang-fast \
	    CXX_FLAGS='-std=c++17 -O1 -Ipre' HARDEN= KERNEL_FLAGS='-O0 -fno-sanitize=all' CFLAGS='-g -O1 -fsanitize=address,undefined -fno-omit-frame-pointer' $(BUILD)/fuzz/feed
	@BUILD=$(BUILD) tests/fuzz/run

# CGAL is no part of this: it takes minutes to compile with sanitizers. Address and undefined behaviour: make test SANITIZE=1, make fuzz.
sanitize: deps
	@tests/deps install valgrind clang libomp-dev
	@$(MAKE) --no-print-directory all
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/threads CC=clang HARDEN= KERNEL_FLAGS=-O1 CXX_FLAGS='-std=c++17 -O1 -Ipre' \
	    CFLAGS='-g -O1 -fsanitize=thread -Wno-pass-failed' all
	@BUILD=$(BUILD) tests/sanitize

allocations: all
	@BUILD=$(BUILD) ONLY=each_allocation ALLOCATIONS=0 sh tests/cli/memory.sh

bench: deps
	@$(MAKE) --no-print-directory all
	@tests/deps install lammps
	@OMP_NUM_THREADS=1 lmp -in cases/bench/lammps_pmb.in -log $(BUILD)/lammps.log -screen none || true
	@$(BUILD)/kirsch-bench $(BUILD)/bench.csv $(BUILD)/lammps.log
	@BUILD=$(BUILD) cases/bench/large $(BUILD)/bench.csv

bench-growth: all
	@$(BUILD)/kirsch-bench --growth
	@BUILD=$(BUILD) cases/bench/precision
	@BUILD=$(BUILD) cases/bench/sizes

oracle: all
	@if pkg-config --exists petsc; then \
	    $(MAKE) --no-print-directory $(BUILD)/tests/oracle/petsc && \
	    OMP_WAIT_POLICY=passive $(BUILD)/tests/oracle/petsc; \
	else echo "skipped: PETSc is not here (Debian: libpetsc-real-dev)"; fi
	@if /usr/bin/python3 -c 'import vtkmodules' 2>/dev/null; then BUILD=$(BUILD) tests/oracle/closed; \
	else echo "skipped: VTK for Python is not here (Debian: python3-vtk9)"; fi

corrections: all $(BUILD)/corrections
	@BUILD=$(BUILD) cases/corrections/table

pores-500: all $(BUILD)/fields
	@$(BUILD)/fields $(or $(GRID),near-boundary) 1 $(or $(SEEDS),500) $(or $(PORES),30) $(or $(SPACING),0.25)

bar: all $(BUILD)/bar
	@BUILD=$(BUILD) cases/bar/table

bench-read: all $(BUILD)/read
	@BUILD=$(BUILD) cases/bench/meshes

bench-tree: all
	@BUILD=$(BUILD) cases/bench/tree

pictures: demo
	@BUILD=$(BUILD) docs/pictures/make

node-order: all $(BUILD)/order
	@BUILD=$(BUILD) cases/node-order/table

equilibrium: all $(BUILD)/plain
	@BUILD=$(BUILD) cases/equilibrium/table

free-grid: all
	@BUILD=$(BUILD) cases/free-grid/table

lloyd-solid: all $(BUILD)/lloyd
	@$(BUILD)/lloyd $(BUILD)/kirsch-gmsh

$(cases): all
	@tests/deps install $(CASES_PACKAGES)
	@BUILD=$(BUILD) FULL='$(FULL)' $@/run

validate: all
	@tests/deps install $(CASES_PACKAGES)
	@BUILD=$(BUILD) cases/validate

soak: all
	@tests/deps install $(CASES_PACKAGES)
	@BUILD=$(BUILD) cases/soak/soak

docs: all
	@$(BUILD)/kirsch --deck-reference > docs/deck.md

sbom: all
	@BUILD=$(BUILD) VERSION='$(VERSION)' tests/sbom > $(BUILD)/kirsch.spdx
	@echo "$(BUILD)/kirsch.spdx: $$(grep -c ^PackageName: $(BUILD)/kirsch.spdx) packages"

format:
	@clang-format -i $$(git ls-files '*.c' '*.h')

install: all
	install -d $(PREFIX)/bin $(PREFIX)/share/kirsch
	install $(programs) $(PREFIX)/bin
	install -m 644 $(scripts) $(PREFIX)/share/kirsch

clean:
	rm -rf $(BUILD)

-include $(library_o:.o=.d) $(kernel_o:.o=.d) $(patsubst %.c,$(BUILD)/%.d,$(programs_c)) $(tests:=.d) \
         $(BUILD)/cases/node-order/order.d $(BUILD)/cases/bench/read.d $(BUILD)/cases/lloyd-solid/lloyd.d \
         $(BUILD)/cases/corrections/corrections.d $(BUILD)/cases/pores-500/fields.d $(BUILD)/cases/bar/bar.d
