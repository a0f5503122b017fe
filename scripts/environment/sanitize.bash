# SPDX-License-Identifier: BSD-3-Clause
# Builds the core and its tests with GCC's sanitizers and runs them: first threads, then addresses and undefined
# behaviour. For scripts/test. The core needs neither ROS nor Python.
#
#   run_sanitizers ROOT [GTEST_FILTER]

run_sanitizers() {
  local root=$1 filter=${2:-*} kind build program failed=0
  local suppressions=$root/tests/sanitizers
  for kind in thread address,undefined; do
    build=$root/.ws/sanitize/${kind//,/-}  # a comma in a path ends an option for the linker
    mkdir -p "$(dirname "$build")"
    # -Wno-tsan: ThreadSanitizer does not know fences. The frames in shared memory have some; their readers map the memory
    # a second time, so it does not compare the accesses anyway.
    echo "[sanitize] building with -fsanitize=$kind in $build"
    cmake -S "$root" -B "$build" -DBUBBLESIM_SANITIZE="$kind" -DBUBBLESIM_WITH_ROS=OFF -DBUBBLESIM_WITH_PYTHON=OFF \
      -DBUBBLESIM_BUILD_TESTS=ON -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g1 -Wno-tsan" \
      -DBUBBLESIM_VIRTUAL_ENV="$root/.ws/venv" > "$build.log" 2>&1 || { cat "$build.log"; return 1; }
    cmake --build "$build" -j "$(nproc)" >> "$build.log" 2>&1 || { tail -n 50 "$build.log"; return 1; }
    for program in "$build"/tests/{codec,sim}/test_*; do
      [[ -f $program && -x $program ]] || continue
      echo "[sanitize] $kind: $(basename "$program")"
      # ThreadSanitizer needs addresses that are not randomised; the path must not lead to the workspace's libraries.
      TSAN_OPTIONS="suppressions=$suppressions/thread.supp exitcode=66" \
        LSAN_OPTIONS="suppressions=$suppressions/leak.supp" UBSAN_OPTIONS="print_stacktrace=1 halt_on_error=1" \
        env -u LD_LIBRARY_PATH setarch -R "$program" --gtest_brief=1 --gtest_filter="$filter" || failed=1
    done
  done
  return $failed
}
