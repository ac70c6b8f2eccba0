#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs with apt what the package needs: Debian 12 with its own ROS 1, Ubuntu 20.04 with Noetic.
# What is needed, package.xml says; what it is called here, scripts/packages/<system>.txt.
#
#   scripts/install.sh           installs what is missing
#   scripts/install.sh --list    prints the apt packages, installs nothing
#
# Exit codes: 0 all is there, 1 apt failed or a command is missing, 2 wrong usage, 3 unknown system,
# 4 a key of package.xml has no apt package.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
packages_dir=scripts/packages

fail() {
  local code=$1
  shift
  printf 'install.sh: %s\n' "$@" >&2
  exit "$code"
}

known_systems() {
  local file
  for file in "$packages_dir"/*.txt; do basename "$file" .txt; done | paste -sd ' '
}

# <ID>-<VERSION_ID> of this machine, such as debian-12.
this_system() {
  [ -r /etc/os-release ] || fail 3 'there is no /etc/os-release: which system is this?' \
    "Known systems: $(known_systems)."
  # shellcheck disable=SC1091
  (. /etc/os-release && printf '%s-%s\n' "${ID:-unknown}" "${VERSION_ID:-unknown}")
}

# The names in every <depend>, <build_depend>, ... of package.xml, comments left out.
package_keys() {
  tr '\n' ' ' < package.xml | sed 's/<!--/\n<!--/g; s/-->/-->\n/g' | sed '/^<!--/d' |
    grep -oE '<[a-z_]*depend[^>]*>[^<]*</' | sed -E 's/^<[^>]*>[[:space:]]*//; s/[[:space:]]*<\/$//' |
    sort -u
}

# The rest of the line `KEY: ...` of the list; nothing if there is none.
entry() {
  sed -n "s/^$1:[[:space:]]*//p" "$list"
}

apt_packages() {
  local key found unknown=()
  entry @tools
  for key in $(package_keys); do
    found=$(entry "$key")
    if [ -n "$found" ]; then printf '%s\n' "$found"; else unknown+=("$key"); fi
  done
  if [ ${#unknown[@]} -gt 0 ]; then
    fail 4 "package.xml names keys that $list has no apt package for: ${unknown[*]}"
  fi
}

installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2> /dev/null)" = installed ]
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    fail 1 "not root, and there is no sudo. As root: $*"
  fi
}

install_missing() {
  local package missing=()
  for package in $1; do
    installed "$package" || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi

  printf 'install.sh: installing %d packages and what they need: %s\n' ${#missing[@]} "${missing[*]}"
  as_root apt-get -q update ||
    printf 'install.sh: apt-get update failed; going on with the lists that are there\n' >&2
  for package in "${missing[@]}"; do
    if [ -z "$(apt-cache --quiet madison "$package" 2> /dev/null)" ]; then
      fail 1 "apt does not know the package $package." "$(source_hint)"
    fi
  done
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends \
    "${missing[@]}" < /dev/null || fail 1 'apt-get install failed, see above'
}

source_hint() {
  case $system in
    ubuntu-*) echo "Set up ROS Noetic's package source first (ROS wiki, Installation/Ubuntu)." ;;
    *) echo "Is 'main' of $system among the sources of apt?" ;;
  esac
}

check_commands() {
  local command missing=()
  # ROS Noetic's commands are on the path only after its set-up.
  export PATH="$PATH:/opt/ros/noetic/bin"
  for command in $(entry @commands); do
    command -v "$command" > /dev/null || missing+=("$command")
  done
  if [ ${#missing[@]} -gt 0 ]; then
    fail 1 "all packages are installed, but these commands are missing: ${missing[*]}"
  fi
}

if [ $# -gt 1 ] || { [ $# -eq 1 ] && [ "$1" != --list ]; }; then
  fail 2 "usage: scripts/install.sh [--list]"
fi
system=$(this_system)
list=$packages_dir/$system.txt
[ -f "$list" ] || fail 3 "this system is $system; known are: $(known_systems)." \
  "For another one, write $list and install ROS 1 there."

packages=$(apt_packages | tr ' ' '\n' | sort -u)
if [ "${1:-}" = --list ]; then
  printf '%s\n' "$packages"
  exit 0
fi
install_missing "$packages"
check_commands
printf 'install.sh: all %d packages are installed\n' "$(wc -w <<< "$packages")"
