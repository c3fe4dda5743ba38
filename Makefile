# The whole project from one place: `make` lists what there is. Every target sets up what it needs first.

BIN := .venv/bin
SHELL := /bin/sh
.DEFAULT_GOAL := help
.PHONY: help setup demo test attack audit soak parity check format serve web bench fit openapi examples lock sbom dist clean

DEMO_MODEL := examples/flange.step
DEMO_QUESTION := What is the diameter of the holes visible from the top?

help: ## list the targets
	@sed -n 's/^\([a-z][a-z-]*\):.*## \(.*\)/\1|\2/p' $(firstword $(MAKEFILE_LIST)) | while IFS='|' read -r name text; do printf '  %-10s %s\n' "$$name" "$$text"; done

setup: ## make .venv with everything pinned in requirements.lock; quick when nothing changed
	@scripts/setup.sh

demo: setup ## answer a question about a model in examples/, with code, timings and a picture
	@mkdir -p build
	$(BIN)/querycad ask $(DEMO_MODEL) "$(DEMO_QUESTION)" --show-code --picture build/demo.png

test: setup ## run all tests, as many at a time as there are cores, at most 4, or JOBS; arguments for pytest in ARGS
	$(BIN)/python -m pytest --numprocesses $(or $(JOBS),auto) --maxprocesses 4 --dist loadfile $(ARGS)

attack: setup ## attack what takes text, files, requests and programs, 2,000 mutants among them; a quarter of an hour
	QUERYCAD_ATTACK=whole $(BIN)/python -m pytest tests/attack tests/llm_sandbox/test_hostile.py tests/llm_sandbox/test_fuzz.py $(ARGS)

audit: setup ## look for known weaknesses: bandit in the sources, pip-audit in what is pinned, where its database is reached
	@scripts/audit.sh

soak: setup ## mixed work on a service of its own for MINUTES, 20 as a rule: latencies, errors, slopes
	$(BIN)/python -m benchmark.perf.soak --minutes $(or $(MINUTES),20) $(ARGS)

parity: setup ## compare the vision networks with the public references: installs PyTorch, takes minutes
	@scripts/parity.sh $(ARGS)

check: setup ## lint, format, types, import layers, scripts; changes nothing
	$(BIN)/ruff check
	$(BIN)/ruff format --check --quiet
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo
	$(BIN)/shellcheck scripts/*.sh .ci/run

format: setup ## rewrite the sources as the formatter wants them
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

serve: setup ## start all services on this machine; stop with Ctrl-C
	$(BIN)/querycad serve

web: setup ## build the page from web/; says what stands in the way
	@scripts/page.sh

bench: setup ## measure accuracy; arguments for querycad bench in ARGS
	$(BIN)/querycad bench $(ARGS)

fit: setup ## fit the weights that rank readings, and print the cross-validated score; about half an hour
	$(BIN)/python -m benchmark.understanding fit

openapi: setup ## write openapi.yaml from the code
	$(BIN)/python -m querycad_api.openapi

examples: setup ## rebuild the example models and their pictures
	$(BIN)/python examples/rebuild.py

lock: setup ## resolve requirements.lock anew; PACKAGES="numpy …" upgrades only those
	scripts/lock.sh $(PACKAGES)

sbom: setup ## write what the product is made of as CycloneDX JSON into build/
	@mkdir -p build
	$(BIN)/python scripts/sbom.py > build/querycad.cdx.json

dist: setup ## build the wheels of all packages, and their bill of materials, into dist/
	rm -rf dist
	for package in packages/* services/*; do $(BIN)/uv build --quiet --no-config --wheel --no-build-isolation --python $(BIN)/python --out-dir dist $$package || exit 1; done
	$(BIN)/python scripts/sbom.py > dist/querycad.cdx.json
	@ls dist

clean: ## remove what can be rebuilt, the environment included
	rm -rf .venv build dist web/node_modules services/api/querycad_api/web/dist .setup-*.log .mypy_cache .pytest_cache .ruff_cache .import_linter_cache .hypothesis .benchmarks
	find packages services examples tests scripts benchmark -name __pycache__ -type d -prune -exec rm -rf {} +
