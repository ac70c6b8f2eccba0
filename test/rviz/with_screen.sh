#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs a program with a screen of its own where Xvfb is installed, else as it is:
#
#   with_screen.sh PROGRAM [ARGUMENT ...]
set -uo pipefail

if ! command -v Xvfb > /dev/null; then
  exec "$@"
fi
folder=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1024x768x24 +extension GLX 3> "$folder/display" 2> "$folder/log" &
screen_pid=$!
trap 'kill "$screen_pid" 2> /dev/null; rm -rf "$folder"' EXIT
for _ in $(seq 100); do
  [ -s "$folder/display" ] && break
  sleep 0.1
done
DISPLAY=":$(cat "$folder/display")" LIBGL_ALWAYS_SOFTWARE=1 "$@"
