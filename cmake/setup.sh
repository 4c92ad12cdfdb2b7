#!/usr/bin/env bash
# Installs what the build needs and this machine lacks (Debian 12+, Ubuntu 24.04+), and does nothing when all is there.
#
#   cmake/setup.sh [tests] [gui]      the build itself is always included
#   cmake/setup.sh sources            only fetch the GUI's third-party sources (systems without apt)
#
# CLOTHLAB_IMGUI_BUNDLE_DIR=DIR       use the imgui-bundle source release unpacked there, download nothing
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build_packages=(g++ cmake ninja-build pkgconf nlohmann-json3-dev libcli11-dev libhwy-dev libeigen3-dev
    liblz4-dev)
test_packages=(catch2
    parallel) # runs the example of docs/sweeps.md
gui_packages=(libglm-dev libstb-dev python3-glad
    libx11-dev libxrandr-dev libxinerama-dev libxcursor-dev libxi-dev libxext-dev # GLFW on X11
    libxkbcommon-dev libwayland-dev libwayland-bin                                # GLFW on Wayland
    libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri)                                  # OpenGL, also without a GPU or display

# What is unpacked of the source release, in its own layout, so that a full copy of it can be used instead.
bundle=third_party/imgui-bundle
bundle_parts=(
    external/imgui/imgui/LICENSE.txt
    'external/imgui/imgui/*.h' 'external/imgui/imgui/*.cpp'
    'external/imgui/imgui/backends/imgui_impl_glfw.*' 'external/imgui/imgui/backends/imgui_impl_opengl3*'
    'external/imgui/imgui/misc/cpp/*'
    'external/imgui_test_engine/imgui_test_engine/imgui_test_engine'
    external/glfw/glfw/{CMake,CMakeLists.txt,LICENSE.md,deps,include,src}
    'external/implot/implot/LICENSE' 'external/implot/implot/*.h' 'external/implot/implot/implot.cpp'
    external/implot/implot/implot_items.cpp
    external/portable_file_dialogs/portable_file_dialogs
    external/ImGuiColorTextEdit/ImGuiColorTextEdit/{LICENSE,TextEditor.cpp,TextEditor.h}
    external/imgui_rich_md/imgui_rich_md/assets/fonts/Roboto/Roboto-{Regular,Bold}.ttf
    'external/imgui_rich_md/imgui_rich_md/assets/fonts/Inconsolata-*'
    external/hello_imgui/hello_imgui/hello_imgui_assets/fonts/Font_Awesome_6_Free-Solid-900.otf
    external/hello_imgui/hello_imgui/hello_imgui_assets/fonts/LICENSE-FontAwesome.txt
    external/hello_imgui/hello_imgui/src/hello_imgui/icons_font_awesome_6.h
    external/hello_imgui/hello_imgui/LICENSE
)

say() { printf 'setup: %s\n' "$*" >&2; }
die() {
    printf 'setup: error: %s\n' "$*" >&2
    exit 1
}

temporary=()
trap '[[ ${#temporary[@]} -eq 0 ]] || rm -rf "${temporary[@]}"' EXIT
trap 'exit 130' INT TERM
new_temporary() { # sets $tmp; not by $(...), whose subshell could not add to the list
    tmp=$(mktemp -d "$@")
    temporary+=("$tmp")
}

# --- distribution packages -------------------------------------------------------------------------------------------

# Sets `missing` to those of the given packages that are not installed. A build tool that is on PATH already, from
# wherever, is as good as the package. Catch2 counts from version 3 on.
find_missing() {
    local -A have=()
    local status name version
    while read -r status name version; do
        [[ $status == ii ]] || continue
        [[ $name == catch2 && ${version%%.*} -lt 3 ]] || have[$name]=1
    done < <(dpkg-query -W -f '${db:Status-Abbrev} ${Package} ${Version}\n' "$@" 2>/dev/null)
    missing=()
    for name in "$@"; do
        [[ -z ${have[$name]:-} ]] || continue
        case $name in
            g++ | cmake) ! command -v "$name" >/dev/null || continue ;;
            ninja-build) ! command -v ninja >/dev/null || continue ;;
            pkgconf) ! command -v pkg-config >/dev/null || continue ;;
        esac
        missing+=("$name")
    done
}

as_root() {
    if [[ $EUID -eq 0 ]]; then
        "$@"
    elif [[ -t 0 ]]; then
        sudo "$@" # may ask for the password
    else
        sudo -n "$@"
    fi
}

apt() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120 -o Dpkg::Use-Pty=0 "$@" \
        >>"$log" 2>&1 </dev/null
}

# Why apt did not do it, in its own words; a mirror out of reach is only a warning to it.
apt_reason() { grep -m 1 -E '^(W: Failed|E:)' "$log" || tail -n 1 "$log"; }

# Sets `unknown` to those of the given packages that apt cannot install; an old Catch2 is as good as none.
find_unknown() {
    local -A known=()
    local name="" key value
    while read -r key value; do
        case $key in
            Candidate:)
                [[ $value == "(none)" || ($name == catch2 && ${value%%.*} -lt 3) ]] || known[$name]=1 ;;
            *:) [[ -n $value ]] || name=${key%:} ;;
        esac
    done < <(LC_ALL=C apt-cache policy "$@" 2>/dev/null)
    unknown=()
    for name in "$@"; do [[ -n ${known[$name]:-} ]] || unknown+=("$name"); done
}

# Debian 12 has Catch2 v3 in its backports only. They are read through a temporary source list with temporary
# indexes, so that nothing of them stays configured here; the mirror is the one this machine uses already.
# There catch2 only stands for libcatch2-dev. Sets `catch2_debs`.
download_catch2_backport() {
    local id codename mirror keyring sandbox
    id=$(. /etc/os-release && printf %s "${ID:-}")
    codename=$(. /etc/os-release && printf %s "${VERSION_CODENAME:-}")
    [[ $id == debian ]] || die "no package catch2 of version 3 here: the tests need it (Debian 12+, Ubuntu 24.04+)"
    mirror=$(apt-get indextargets --format '$(CODENAME) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
        sed -n "s/^$codename main //p" | head -n 1)
    [[ -n $mirror ]] || die "no apt source for '$codename main' is configured: catch2 from $codename-backports needs its mirror"
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    [[ ! -e $keyring ]] || keyring="[signed-by=$keyring]"
    [[ $keyring == \[* ]] || keyring=

    new_temporary
    sandbox=$tmp
    mkdir -p "$sandbox/lists/partial" "$sandbox/archives/partial"
    chmod -R a+rx "$sandbox"
    echo "deb $keyring $mirror $codename-backports main" >"$sandbox/sources.list"
    local options=(-qq -o Dir::Etc::SourceList="$sandbox/sources.list" -o Dir::Etc::SourceParts=/dev/null
        -o Dir::State::Lists="$sandbox/lists" -o Dir::Cache::Archives="$sandbox/archives"
        -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=)
    (cd "$sandbox" && apt-get "${options[@]}" update &&
        apt-get "${options[@]}" download catch2 libcatch2-dev) >>"$log" 2>&1 </dev/null ||
        die "cannot get catch2 from $codename-backports: $(apt_reason)"
    catch2_debs=("$sandbox"/*.deb)
}

install_packages() { # the missing ones, named in $missing
    command -v apt-get >/dev/null || die "this system has no apt: install ${missing[*]} (or their like) by hand, then build" \
        "with 'cmake --preset release' ('cmake/setup.sh sources' fetches the GUI's sources)"
    [[ $EUID -eq 0 ]] || command -v sudo >/dev/null ||
        die "not root and no sudo: let an administrator run 'apt-get install ${missing[*]}'"
    [[ $EUID -eq 0 || -t 0 ]] || sudo -n true 2>/dev/null ||
        die "sudo wants a password and there is no terminal: let an administrator run 'apt-get install ${missing[*]}'"

    new_temporary
    log=$tmp/log
    local wanted=("${missing[@]}") names=()
    find_unknown "${wanted[@]}"
    if [[ ${#unknown[@]} -gt 0 ]]; then # a fresh image has no package lists
        apt update || die "apt-get update failed: $(apt_reason)"
        find_unknown "${wanted[@]}"
    fi
    local name
    for name in "${wanted[@]}"; do
        if [[ " ${unknown[*]} " != *" $name "* ]]; then
            names+=("$name")
        elif [[ $name == catch2 ]]; then
            download_catch2_backport
            names+=("${catch2_debs[@]}")
        elif grep -q '^W: Failed' "$log"; then
            die "apt cannot read its package lists, so there is no package $name: $(apt_reason)"
        else
            die "no package $name in this system's apt sources (Debian 12+ or Ubuntu 24.04+ with universe have it)"
        fi
    done
    # Stale lists name versions that the mirror no longer has: read them anew, and try once more.
    apt install --no-install-recommends "${names[@]}" ||
        { apt update && apt install --no-install-recommends "${names[@]}"; } ||
        die "apt-get install failed: $(apt_reason)"
    find_missing "${wanted[@]}"
    [[ ${#missing[@]} -eq 0 ]] || die "still missing after the installation: ${missing[*]}"
}

# --- third-party sources of the GUI ----------------------------------------------------------------------------------

bundle_key() { printf '%s\n' "${bundle_parts[@]}" | cat cmake/requirements.txt - | cksum; }

have_bundle() {
    if [[ -n ${CLOTHLAB_IMGUI_BUNDLE_DIR:-} ]]; then
        [[ -e $CLOTHLAB_IMGUI_BUNDLE_DIR/external/imgui/imgui/imgui.h ]] ||
            die "CLOTHLAB_IMGUI_BUNDLE_DIR=$CLOTHLAB_IMGUI_BUNDLE_DIR has no external/imgui/imgui/imgui.h"
    else
        [[ -e $bundle/.complete && $(<"$bundle/.complete") == "$(bundle_key)" ]]
    fi
}

find_pip() { # sets `python`: the first python3 that has pip and is new enough for the release
    for python in python3 /usr/bin/python3; do
        "$python" -c 'import sys, pip; sys.exit(sys.version_info < (3, 10))' 2>/dev/null && return
    done
    return 1
}

fetch_bundle() {
    find_pip || die "no python3 (3.10 or newer) with pip: imgui-bundle cannot be downloaded"
    mkdir -p third_party
    # Unpacked beside its place and then renamed, so that an interrupted run leaves nothing half done behind.
    new_temporary third_party/.unpack.XXXXXX
    "$python" -m pip download --quiet --disable-pip-version-check --no-input --no-deps --require-hashes \
        --requirement cmake/requirements.txt --dest "$tmp" >"$tmp/log" 2>&1 </dev/null ||
        die "cannot download imgui-bundle: $(grep -m 1 ERROR "$tmp/log" || tail -n 1 "$tmp/log")"
    mkdir "$tmp/new"
    tar -xzf "$tmp"/imgui_bundle-*.tar.gz -C "$tmp/new" --strip-components=1 --no-same-owner \
        --wildcards --no-wildcards-match-slash "${bundle_parts[@]/#/*/}" ||
        die "cannot unpack imgui-bundle: a part listed in cmake/setup.sh is not in it"
    bundle_key >"$tmp/new/.complete"
    rm -rf "$bundle"
    mv "$tmp/new" "$bundle"
}

# --- what is wanted, what is missing, one line about it --------------------------------------------------------------

wanted=("${build_packages[@]}")
want_gui= only_sources=
for argument in "$@"; do
    case $argument in
        tests) wanted+=("${test_packages[@]}") ;;
        gui) wanted+=("${gui_packages[@]}") want_gui=1 ;;
        sources) want_gui=1 only_sources=1 ;;
        *) die "unknown argument '$argument': expected tests, gui or sources" ;;
    esac
done

need_bundle=
if [[ -n $want_gui ]] && ! have_bundle; then
    need_bundle=1
    find_pip || wanted+=(python3-pip)
fi
missing=()
[[ -n $only_sources ]] || find_missing "${wanted[@]}"

plan=()
describe() { # WHY PACKAGE...: adds those of the packages that are missing
    local why=$1 names=() name
    shift
    for name in "$@"; do [[ " ${missing[*]} " != *" $name "* ]] || names+=("$name"); done
    [[ ${#names[@]} -eq 0 ]] || plan+=("${names[*]} ($why)")
}
describe "to build" "${build_packages[@]}"
describe "for the tests" "${test_packages[@]}"
describe "for the window and OpenGL" "${gui_packages[@]}"
describe "to fetch imgui-bundle" python3-pip
[[ -z $need_bundle ]] || plan+=("imgui-bundle's sources into third_party/ (Dear ImGui, GLFW, fonts)")
[[ ${#plan[@]} -gt 0 ]] || exit 0

text=$(printf ', %s' "${plan[@]}")
say "installing ${text:2}"
[[ ${#missing[@]} -eq 0 ]] || install_packages
[[ -z $need_bundle ]] || fetch_bundle
