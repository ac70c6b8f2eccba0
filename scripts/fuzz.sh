#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Feeds the back end with damaged graphs and files, under the address and undefined-behaviour
# sanitizers: whatever it is given, it answers with a report or a named error. Stops at the first
# time that it does not, and names the seed.
#
#   scripts/fuzz.sh [GRAPHS [MUTATIONS [SEED]]]     10000 of each unless told
#
# Builds into build/fuzz, without ROS. FUZZ_BUILD names another folder.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
graphs="${1:-10000}"
mutations="${2:-$graphs}"
seed="${3:-1}"
build="${FUZZ_BUILD:-build/fuzz}"
export PATH="/usr/bin:$PATH"

# MRPT's libraries are not instrumented, and their types have no vtables that the check could know.
sanitizers='-fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=all'
options=(-DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=-O1 -g -fno-omit-frame-pointer $sanitizers")
if command -v ccache > /dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
cmake -S test/fuzz -B "$build" "${options[@]}" > /dev/null
cmake --build "$build" --parallel "${FUZZ_JOBS:-$(nproc)}"

export UBSAN_OPTIONS=print_stacktrace=1
exec "$build/fuzz_back_end" --graphs "$graphs" --mutations "$mutations" --seed "$seed"
