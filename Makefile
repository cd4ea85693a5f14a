# `make demo` and `make test` need nothing but make and Python 3.11 or newer: each makes .venv first.
# (On Windows make needs a POSIX shell too, as Git brings it; README.md has the commands without make.)

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

VENV := .venv
DEMO_FOLDER ?= out/demo
SITE ?= out/site
PORT ?= 8000
EXTRAS ?= dev

# The newest Python that runs and can make an environment; only asked for where there is none yet.
ifeq ($(OS),Windows_NT)
PYTHON ?= py -3
BIN := $(VENV)/Scripts
else
PYTHON ?= $(shell for python in python3.14 python3.13 python3.12 python3.11 python3 python; do \
	"$$python" -c "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))" >/dev/null 2>&1 \
	&& { echo "$$python"; break; }; done)
BIN := $(VENV)/bin
endif

RUN := $(BIN)/python
STAMP := $(VENV)/.installed

.PHONY: help setup check test quick demo bench stress mutants docs docs-serve clean

help:  ## list what make can do
	@echo "make demo    render four scenes and a page that shows them, in $(DEMO_FOLDER)"
	@echo "make test    run every test; make test WING=engine, school, site or cli: those of one wing"
	@echo "make quick   run the main laws of every room, in less than a minute"
	@echo "make check   formatting, lint, types, layers"
	@echo "make bench   measure, print and write JSON"
	@echo "make stress  thousands of ill-conditioned scenes beside their well-conditioned twins"
	@echo "make mutants grade every known submission, right and wrong, and print what became of it"
	@echo "make docs    build the site in $(SITE), with a picture of every scene that it shows"
	@echo "make docs-serve  build it and show it at http://127.0.0.1:$(PORT)"
	@echo "make setup   make $(VENV) and install into it (the others do it when needed)"
	@echo "make clean   remove $(VENV) and all that was made"

setup: $(STAMP)
	@:

# An environment that still runs is kept; one whose Python is gone or too old is made anew.
RUNS := "$(RUN)" -c "import sys; sys.exit(sys.version_info < (3, 11))" >/dev/null 2>&1
ifneq ($(shell $(RUNS) && echo yes),yes)
.PHONY: $(STAMP)
endif

# A sign of life every two seconds beside the program that follows on the same line, until that line's shell ends.
DOTS := while sleep 2 && kill -0 $$$$ 2>/dev/null; do printf .; done &

# The extras are installed by uv, in a quarter of pip's time; by pip where uv can't be had or fails.
PIP := "$(RUN)" -m pip --disable-pip-version-check -qq install
UV := "$(RUN)" -m uv pip install --quiet --compile-bytecode --python "$(RUN)"
INSTALL = { $(PIP) uv && $(UV) --editable ".[$(EXTRAS)]"; } >/dev/null 2>&1 || $(PIP) --editable ".[$(EXTRAS)]"

$(STAMP): pyproject.toml
	@printf "installing into $(VENV): about 210 MB to download, half a minute, once "
	@$(DOTS) $(RUNS) || $(or $(PYTHON),$(error no Python 3.11 or newer with venv and pip was found: install one, or say make PYTHON=...)) -m venv --clear $(VENV)
	@$(DOTS) $(INSTALL)
	@echo
	@"$(RUN)" -c "open('$(STAMP)', 'w').close()"

check: $(STAMP)
	"$(RUN)" -m ruff format --check .
	"$(RUN)" -m ruff check .
	"$(RUN)" -m mypy
	"$(RUN)" -m course release --check
	"$(RUN)" -m pytest -q tests/test_layers.py

# Each process begins with half of the tests; who is done takes over. Bytecode is kept even where the environment says
# otherwise: hundreds of processes would compile the same files again.
test quick stress: export PYTHONDONTWRITEBYTECODE :=
# Every core has a process already: threads of BLAS would only wait for each other.
test quick stress: export OPENBLAS_NUM_THREADS := 1
# Each folder of tests belongs to one wing (tests/test_wings.py).
WING_engine := base engine
WING_school := school
WING_site := docs
WING_cli := benchmarking cli
WINGS := engine school site cli
test: $(STAMP)
	$(if $(filter-out $(WINGS),$(WING)),$(error WING=$(WING) is none of $(WINGS)))
	"$(RUN)" -m pytest -q -n auto --dist worksteal $(addprefix tests/,$(WING_$(WING)))

quick: $(STAMP)
	"$(RUN)" -m pytest -q -n auto --dist worksteal @tests/quick.txt

demo: $(STAMP)
	@"$(RUN)" -m course demo --out $(DEMO_FOLDER)

bench: $(STAMP)
	"$(RUN)" -m benchmarks

stress: $(STAMP)
	"$(RUN)" -m benchmarks.stress
	"$(RUN)" -m pytest -q -n auto --timeout=1800 --hypothesis-profile=stress @tests/long.txt

mutants: $(STAMP)
	"$(RUN)" -m benchmarks.mutants

# What the site needs is installed when it is first built. A first build writes its pages with grey pictures, so that
# they can be read while the others are drawn, in a process for each core. Pictures are kept in out/docs: a build that is
# ended goes on with them; `make docs SPHINXOPTS="-D pictures=blank"` does without, for a quick look at the text.
docs: $(STAMP)
	$(if $(wildcard docs/conf.py),,$(error this copy has no docs/: the site is made from the whole course))
	@"$(RUN)" -c "import furo, ipykernel, latex2mathml, myst_parser, nbclient, sphinx" 2>/dev/null \
		|| "$(RUN)" -m pip --disable-pip-version-check -qq install --editable ".[docs]"
	@$(if $(findstring pictures=blank,$(SPHINXOPTS)),,\
		PYTHONPATH=docs "$(RUN)" -m sitebuild.ahead out/docs/doctrees $(SITE))
	@"$(RUN)" -m sphinx -W --keep-going -q -b html -d out/docs/doctrees $(SPHINXOPTS) docs $(SITE)
	@echo "$(SITE)/index.html"

docs-serve: docs
	"$(RUN)" -m http.server --bind 127.0.0.1 --directory $(SITE) $(PORT)

clean:
	@"$(or $(PYTHON),python3)" -c "import shutil; [shutil.rmtree(f, True) for f in '$(VENV) build dist out .pytest_cache .mypy_cache .ruff_cache .hypothesis'.split()]"
