# The commands a user types. The build itself is plain CMake: see CMakePresets.json.
#   GUI=OFF                          no window: library and command line only, in build/headless
#   CLOTHLAB_IMGUI_BUNDLE_DIR=DIR    use this unpacked imgui-bundle source release, download nothing

GUI ?= ON
SCENE ?=
ARGS ?=
# Another build folder; only the tests with this label.
DIR ?=
LABEL ?=
export CLOTHLAB_IMGUI_BUNDLE_DIR

gui := $(if $(filter OFF Off off NO no 0 FALSE false,$(GUI)),OFF,ON)
preset := $(if $(filter ON,$(gui)),release,headless)
dir := $(or $(DIR),$(if $(filter ON,$(gui)),build,build/headless))
needs := $(if $(filter ON,$(gui)),gui)
jobs := $(shell nproc)
# A user's newer compiler may know a warning that ours does not; in CI each is an error.
werror := CLOTHLAB_WERROR:BOOL=$(if $(CI),ON,OFF)
bundle := $(if $(CLOTHLAB_IMGUI_BUNDLE_DIR),$(abspath $(CLOTHLAB_IMGUI_BUNDLE_DIR)),$(CURDIR)/third_party/imgui-bundle)

# $(call configure,PRESET,FOLDER,GUI,CACHE-LINE...): only if the folder is not configured so already; ninja itself
# runs CMake again when a CMake file or the list of sources changes.
configure = @( test -f $(2)/build.ninja && for line in $(4) CLOTHLAB_GUI:BOOL=$(3) \
	$(if $(filter ON,$(3)),'CLOTHLAB_IMGUI_BUNDLE_DIR:PATH=$(bundle)'); \
	do grep -qsxF -e "$$line" $(2)/CMakeCache.txt || exit 1; done ) || \
	cmake --preset $(1) -B $(2) $(addprefix -D,$(4)) -DCLOTHLAB_GUI:BOOL=$(3) \
	$(if $(filter ON,$(3)),'-DCLOTHLAB_IMGUI_BUNDLE_DIR:PATH=$(bundle)')

# `run` neither needs nor builds the tests, but leaves them configured if they are.
tests_if_configured = $(shell grep -sxF CLOTHLAB_TESTS:BOOL=ON $(dir)/CMakeCache.txt || echo CLOTHLAB_TESTS:BOOL=OFF)

# $(call sanitize,PRESET,FOLDER,GUI). The sanitizers of older compilers cannot cope with much randomisation of
# addresses, so it is off where that is allowed.
define sanitize
$(call configure,$(1),$(2),$(3),CLOTHLAB_TESTS:BOOL=ON)
cmake --build $(2)
@$$(setarch -R true 2>/dev/null && echo setarch -R) ctest --preset $(1) --parallel $(jobs)
endef

.DEFAULT_GOAL := help
.PHONY: help run build test test-sanitizers format clean
.NOTPARALLEL:

help:
	@echo 'make run [SCENE=FILE] [ARGS=...]   install what is missing, build, open the lab (build/clothlab ARGS SCENE)'
	@echo 'make test                          the same for the tests'
	@echo 'make test-sanitizers               the tests under address+undefined and thread sanitizers'
	@echo 'make build                         only build'
	@echo 'make format                        clang-format the sources'
	@echo 'make clean                         remove build/ (third_party/ stays)'
	@echo 'Each with GUI=OFF: library and command line only, no GUI package needed, in build/headless.'

build:
	@cmake/setup.sh $(needs)
	$(call configure,$(preset),$(dir),$(gui),$(tests_if_configured) $(werror))
	@cmake --build $(dir) --target clothlab

run: build
	$(dir)/clothlab $(ARGS) $(SCENE)

test:
	@cmake/setup.sh tests $(needs)
	$(call configure,$(preset),$(dir),$(gui),CLOTHLAB_TESTS:BOOL=ON $(werror))
	cmake --build $(dir)
	ctest --test-dir $(dir) --output-on-failure --no-tests=error --parallel $(jobs) $(addprefix --label-regex ,$(LABEL))

test-sanitizers:
	@cmake/setup.sh tests $(needs)
	$(call sanitize,asan-ubsan,build/asan,$(gui))
	$(call sanitize,tsan,build/tsan,OFF)

format:
	find src tests -name '*.cpp' -o -name '*.h' | xargs clang-format -i

clean:
	rm -rf build
