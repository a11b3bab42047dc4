#!/usr/bin/env bash
# Prepares a bare Debian machine and the virtual environment: ./tools/setup.sh [test|browser]
# PYTHON names the interpreter of a new environment (3.11 or later; default python3).
set -euo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-python3}

need=()
command -v g++ >/dev/null || need+=(g++)
"$python" -c 'import ensurepip, venv' 2>/dev/null || need+=(python3-venv)
has_headers='import os, sys, sysconfig; sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))'
"$python" -c "$has_headers" 2>/dev/null || need+=(python3-dev)
if [ "${1:-}" = test ]; then
  [ -e /usr/include/gtest/gtest.h ] || need+=(libgtest-dev)
  [ -e /usr/include/eigen3/Eigen/Core ] || need+=(libeigen3-dev)  # the sanitized tests build without pip, which would bring it
fi
if [ "${1:-}" = browser ]; then
  command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null || need+=(chromium)
fi
if [ ${#need[@]} -gt 0 ]; then
  if [ "$(id -u)" = 0 ]; then sudo=; elif command -v sudo >/dev/null; then sudo=sudo; else
    echo "setup: these Debian packages are missing: ${need[*]}; install them as root (apt-get install ${need[*]})" >&2
    exit 2
  fi
  echo "setup: installing ${need[*]}"
  $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq "${need[@]}" >/dev/null
fi
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
  { echo "setup: $("$python" --version) is too old; set PYTHON to an interpreter of 3.11 or later" >&2; exit 2; }
[ -x .venv/bin/pip ] || "$python" -m venv .venv
.venv/bin/pip install -q --disable-pip-version-check --upgrade 'pip>=25.1'
