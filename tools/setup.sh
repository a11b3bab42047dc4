#!/usr/bin/env bash
# Prepares a bare Debian machine and the virtual environment: ./tools/setup.sh [test]
set -euo pipefail
cd "$(dirname "$0")/.."

need=()
command -v g++ >/dev/null || need+=(g++)
python3 -c 'import ensurepip, venv' 2>/dev/null || need+=(python3-venv)
[ -e /usr/include/python3.11/Python.h ] || python3 -c 'import sysconfig,os,sys; sys.exit(not os.path.exists(sysconfig.get_path("include")+"/Python.h"))' 2>/dev/null || need+=(python3-dev)
if [ "${1:-}" = test ]; then
  [ -e /usr/include/gtest/gtest.h ] || need+=(libgtest-dev)
  [ -e /usr/include/eigen3/Eigen/Core ] || need+=(libeigen3-dev)  # the sanitized tests build without pip, which would bring it
fi
if [ ${#need[@]} -gt 0 ]; then
  if [ "$(id -u)" = 0 ]; then sudo=; elif command -v sudo >/dev/null; then sudo=sudo; else
    echo "setup: these Debian packages are missing: ${need[*]}; install them as root (apt-get install ${need[*]})" >&2
    exit 2
  fi
  echo "setup: installing ${need[*]}"
  $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq "${need[@]}" >/dev/null
fi
[ -x .venv/bin/pip ] || python3 -m venv .venv
.venv/bin/pip install -q --disable-pip-version-check --upgrade 'pip>=25.1'
