#!/usr/bin/env bash
# What a new user does, inside the installation that tests/fresh/run.sh made:
#
#   bash steps.sh COMMIT [STEP…]
#
# It clones ~/phasetree.bundle, runs the steps in order and stops at the first that fails. ~/result says in a line how it
# went, ~/logs/STEP.log has each step's output.
set -uo pipefail

commit=$1
shift
all=(quickstart tests command pip package)
chosen=("$@")
[ ${#chosen[@]} -gt 0 ] || chosen=("${all[@]}")

clone="$HOME/my sources/phasetree"
mkdir -p "$HOME/logs" "$HOME/my sources"
if [ ! -e "$clone/.git" ]; then
    git -c init.defaultBranch=main clone --quiet --no-checkout "$HOME/phasetree.bundle" "$clone" || exit 1
else
    git -C "$clone" fetch --quiet "$HOME/phasetree.bundle" || exit 1
fi
git -C "$clone" -c advice.detachedHead=false checkout --quiet --detach "$commit" || exit 1
cd "$clone" || exit 1

# picture_is_lit FILE: it is an image, and neither black nor white.
picture_is_lit() {
    oiiotool --stats "$1" | awk -v file="$1" '
        /Stats Avg:/ { found = 1; if (!($3 > 5 && $3 < 250)) { print file " has the mean " $3 " of 255"; exit 1 } }
        END { if (!found) { print file " is no image"; exit 1 } }'
}

# The first command of the README.
step_quickstart() {
    bash tracer/quickstart.sh && [ -s hourglass.exr ] && picture_is_lit hourglass.png
}

# The second.
step_tests() {
    bash tests/run.sh
}

# The command that the tests have built.
step_command() {
    local phasetree="$clone/build/release/tracer/phasetree" format out=$HOME/out
    [ -x "$phasetree" ] || phasetree="$clone/build/quickstart/tracer/phasetree"
    mkdir -p "$out"
    "$phasetree" --version || return 1
    "$phasetree" render scenes/hourglass.json --spp 8 --size 160x200 -o "$out/small picture.png" || return 1
    picture_is_lit "$out/small picture.png" || return 1
    for format in 3mf stl obj glb ply; do
        "$phasetree" export scenes/hourglass.json --spacing 0.05 -o "$out/glass.$format" || return 1
        [ -s "$out/glass.$format" ] || return 1
    done
    "$phasetree" export scenes/hourglass.json -o "$out/page.html" || return 1
    "$phasetree" export scenes/hourglass.json -o "$out/shader.glsl" || return 1
    view "$phasetree" scenes/hourglass.json
}

# view PHASETREE SCENE: the live view answers with its page, and ends on Ctrl-C.
view() {
    local log=$HOME/logs/view.log address='' page i process status
    # In the background a shell ignores Ctrl-C for its children unless job control is on. Whoever started this script in
    # the background may have ignored it already.
    set -m
    env --default-signal=INT "$1" view "$2" >"$log" 2>&1 &
    process=$!
    set +m
    for ((i = 0; i < 600; ++i)); do
        address=$(grep -oE 'http://[^ ]+' "$log" | head -n 1)
        [ -z "$address" ] || break
        kill -0 "$process" 2>/dev/null || break
        sleep 0.1
    done
    cat "$log"
    if [ -z "$address" ]; then
        echo "phasetree view named no address within a minute"
        kill "$process"
        return 1
    fi
    page=$(fetch "$address") || page=
    kill -INT "$process"
    wait "$process"
    status=$?
    if [[ $page != *"<html"* ]]; then
        echo "$address answered with no page"
        return 1
    fi
    if [ "$status" -ne 0 ]; then
        echo "phasetree view ended with $status on Ctrl-C"
        return 1
    fi
}

# fetch http://HOST:PORT/PATH, with bash alone: a machine without the tests' packages has neither curl nor Python.
fetch() {
    local host port path
    [[ $1 =~ ^http://([^:/]+):([0-9]+)(/.*)?$ ]] || return 1
    host=${BASH_REMATCH[1]} port=${BASH_REMATCH[2]} path=${BASH_REMATCH[3]:-/}
    exec 5<>"/dev/tcp/$host/$port" || return 1
    printf 'GET %s HTTP/1.1\r\nHost: %s:%s\r\nConnection: close\r\n\r\n' "$path" "$host" "$port" >&5
    timeout 20 cat <&5
    exec 5>&- 5<&-
}

# The Python package, as plugins/python/README.md says.
step_pip() {
    sudo apt-get -qq install -y --no-install-recommends python3-venv python3-pip python3-setuptools python3-wheel \
        pybind11-dev python3-dev python3-numpy || return 1
    rm -rf environment
    python3 -m venv --system-site-packages environment || return 1
    (cd plugins/python && ../../environment/bin/python -m pip install . --no-build-isolation --no-deps --no-index) || return 1
    (cd / && "$clone/environment/bin/python" -c '
import phasetree as pt
ball = pt.phase("glass", pt.clear(ior=1.5))(pt.sphere(1))
assert list(ball.label([(0, 0, 0), (2, 0, 0)])) == [1, 0], ball.label([(0, 0, 0), (2, 0, 0)])
print(pt.__version__)')
}

# The Debian package, and the C99 example against it.
step_package() {
    local package=$HOME/out/package cc_flags
    rm -rf "$package" && mkdir -p "$package"
    cpack -G DEB --config build/release/CPackConfig.cmake -B "$package" || return 1
    # apt reads local packages as a user of its own, who may not enter a home folder.
    sudo cp "$package"/phasetree*.deb /tmp/ && sudo apt-get -qq install -y --no-install-recommends /tmp/phasetree*.deb || return 1
    (cd / && phasetree --version) || return 1
    local name
    name=$(pkg-config --list-all | awk '/^phasetree-embree/ { print $1; exit }')
    cc_flags=$(pkg-config --cflags --libs "$name") || return 1
    # shellcheck disable=SC2086 # several flags
    cc -std=c99 -Wall -Wextra -Werror /usr/share/doc/phasetree/examples/phases.c -o "$HOME/out/phases" $cc_flags -lm || return 1
    "$HOME/out/phases" /usr/share/phasetree/scenes/hourglass.json | tee "$HOME/out/phases.txt" || return 1
    grep -q 'glass -> sand' "$HOME/out/phases.txt"
}

results=()
for step in "${chosen[@]}"; do
    log=$HOME/logs/$step.log
    printf '%s …\n' "$step"
    begin=$(date +%s)
    status=0
    "step_$step" </dev/null >"$log" 2>&1 || status=$?
    minutes=$(awk -v s=$(($(date +%s) - begin)) 'BEGIN { printf "%.1f", s / 60 }')
    if [ "$status" -ne 0 ]; then
        tail -n 60 "$log"
        printf '%s FAILED after %s min; its output is in ~/logs/%s.log\n' "$step" "$minutes" "$step"
        results+=("$step FAILED ($minutes)")
        break
    fi
    details=$minutes
    # CTest's summary: how many passed, and what was skipped.
    tests=$(sed -n 's/.*tests passed.* out of \([0-9]*\)/\1/p' "$log" | tail -n 1)
    skipped=$(grep -c '(Skipped)$' "$log" || true)
    [ "$step" != tests ] || details="$minutes, $tests tests, $skipped skipped"
    printf '%s passed: %s min\n' "$step" "$details"
    results+=("$step $details")
done
(IFS=';' && printf '%s' "${results[*]}") | sed 's/;/; /g' >"$HOME/result"
exit "$status"
