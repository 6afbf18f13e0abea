# `make check` is what CI runs. Set PYTHON to the interpreter of your own environment.
PYTHON ?= .venv-dev/bin/python

# What breaks first where another library is older: drawing, files, sparse solvers, all commands.
LEANING = tests/plots tests/sheets/test_workbook.py tests/sheets/test_pdf_page.py \
	tests/files/tables/test_spreadsheet.py tests/web/test_floods.py tests/web/test_refusals.py \
	tests/cli/league/test_report.py::test_the_demo_league_gives_its_files_and_a_sheet \
	tests/chains/test_factorization.py tests/chains/test_spectrum.py tests/ratings/test_fitted.py

.PHONY: catalogs column-tables check check-rest check-drift lint types test slow thorough doctests lowest layers docs reports drift bench \
	page-pictures bundle dist clean

check:            ## what CI runs, on the last commit, in new virtual environments
	.ci/run

check-rest: slow docs lowest check-drift doctests types lint   ## what CI checks after the tests, side by side, the long steps first

check-drift: docs   ## what the pages are made of is made again once they are done
	$(MAKE) drift

lint:
	$(PYTHON) -m ruff format --check .
	$(PYTHON) -m ruff check .

types:
	$(PYTHON) -m mypy

column-tables:    ## the tables of columns in docs/reference/files.md, from the schemas themselves
	$(PYTHON) docs/column_tables.py

test:             ## the tests that are not slow
	$(PYTHON) -m pytest -q -n logical -m "not slow"

slow:             ## what else CI runs: kills, other processes, whole evenings, large studies, a real browser
	EVENBREAK_TIER=ci PYTHON=$(PYTHON) .ci/browse -n logical -m "slow and not thorough"

thorough:         ## before a release: 200 or more of each attack in tests/tries.md, evenings in a browser; takes hours
	EVENBREAK_TIER=thorough EVENBREAK_TRIES=200 PYTHON=$(PYTHON) .ci/browse -n logical -m "thorough or drawn"

doctests:         ## the examples in the docstrings of the sources
	$(PYTHON) -m pytest -q src

lowest:           ## tests that lean on other libraries, at the lowest versions declared
	$(PYTHON) -m venv .venv-lowest
	$(PYTHON) .ci/lowest_versions.py > .venv-lowest/versions.txt
	.venv-lowest/bin/python -m pip install -q -c .venv-lowest/versions.txt -e '.[excel,symbolic]' \
		pytest hypothesis pytest-xdist
	EVENBREAK_TIER=first .venv-lowest/bin/python -m pytest -q -n logical -W ignore::DeprecationWarning \
		-m "not slow" -k "not extended_precision" $(LEANING)

layers:           ## imports in one direction, files and terminal only at the end
	$(PYTHON) -m pytest -q tests/test_layers.py

# What is said with these is translated.
SAID = say refuse worded say_as:1c,2 say_count:1,2 EvenbreakError AlreadyError InputError DataError GameError ChainError AccuracyError \
	WorkerError RefusalError ProblemError MovedOnError TakenBeforeError add:2 note:2 warning:3 form_warning:3 refusal:2 refused:2

catalogs:       ## collect the sentences that pages show into each language's catalog
	$(PYTHON) -m babel.messages.frontend -q extract -F babel.cfg --no-default-keywords $(addprefix -k ,$(SAID)) \
		--no-location --sort-output --width 100 -o evenbreak.pot .
	for po in src/evenbreak/words/locale/*/LC_MESSAGES/evenbreak.po; do \
		$(PYTHON) -m babel.messages.frontend -q update -i evenbreak.pot -o $$po -D evenbreak \
		-l $$(basename $$(dirname $$(dirname $$po))) -N --ignore-obsolete --width 100 \
		--ignore-pot-creation-date; done
	rm evenbreak.pot

docs:             ## HTML pages in docs/_build, a warning is an error
	$(PYTHON) -m sphinx -W --keep-going -q -b html docs docs/_build/html

reports:          ## make again every committed output that a script makes
	$(PYTHON) data/make_demo_league.py
	$(PYTHON) data/make_demo_season.py
	$(PYTHON) data/make_demo_teams.py
	$(PYTHON) data/make_drill_log.py
	$(PYTHON) data/make_demo_evening.py
	$(PYTHON) data/make_practice.py
	$(PYTHON) -m evenbreak report data/demo_league.csv --out reports/demo_league --page --paper a4 > demo_league.txt
	mv demo_league.txt reports/demo_league/sheet.txt
	$(PYTHON) -m evenbreak reproduce --out reports
	$(PYTHON) docs/images/make_images.py

# What docs/images/make_images.py writes.
DRAWN = docs/images docs/gallery.md docs/_static/essentials.html

drift: reports    ## fail if what is committed is not what the scripts make
	git diff --exit-code -- reports data $(DRAWN)
	test -z "$$(git status --porcelain -- reports data $(DRAWN))"

page-pictures:    ## the README's and the tutorial's pictures of the page, in a real browser
	$(PYTHON) docs/images/page_pictures.py

dist:             ## the sdist, and the wheel that it gives, as the package index wants them
	python3 -m venv .venv-dist
	.venv-dist/bin/python -m pip install -q build check-wheel-contents twine
	rm -rf dist build/checkout
	.venv-dist/bin/python -m build -q
	.venv-dist/bin/python -m build -q --wheel -o build/checkout
	cmp dist/*.whl build/checkout/*.whl
	.venv-dist/bin/twine check --strict dist/*
	.venv-dist/bin/check-wheel-contents dist/*.whl

bundle:           ## build/evenbreak-VERSION-PLATFORM: the program that needs no Python, for this platform
	python3 packaging/bundle.py

bench:            ## each benchmark beside the bare floor it is compared with
	$(PYTHON) -m pytest -q -o python_files='bench_*.py' -o addopts='--import-mode=importlib' \
		--benchmark-columns=min,median,rounds --benchmark-group-by=group benchmarks

clean:
	rm -rf build dist docs/_build sheet .venv .venv-bundle .venv-dev .venv-dist .venv-lowest .pytest_cache .mypy_cache .ruff_cache
