# SPDX-License-Identifier: BSD-3-Clause
# Builds with GCC's sanitizers and runs tests: the core with ThreadSanitizer, then all with AddressSanitizer and
# UndefinedBehaviorSanitizer. For scripts/test; see CONTRIBUTING.md.
#
#   run_sanitizers ROOT [GTEST_FILTER]     with a filter only C++ tests

# What C++ does for Python and for ROS.
PYTHON_TESTS=(tests/bindings tests/ros1 tests/ros2 tests/scripting tests/app tests/remote tests/observers)
# Limits of memory, because AddressSanitizer keeps what was freed for a while, and a launch file, because rosrun finds its
# program in several builds of the clone.
LEFT_OUT=(
  tests/ros1/test_load.py::test_stopped_subscriber_costs_its_queue_and_the_others_nothing
  tests/remote/test_hostile_clients.py::test_signals_and_custom_data_have_a_limit
  tests/remote/test_hostile_clients.py::test_replies_that_are_not_read_fill_no_memory
  tests/ros2/test_both.py::test_a_launch_file_starts_both_on_simulated_time
)

run_sanitizers() {
  local root=$1 filter=${2:-*} failed=0
  local with_threads=$filter
  [[ $filter != '*' ]] || with_threads='*-Snapshot.*'  # those have one thread, and take many minutes
  build_sanitized "$root" thread OFF || return 1
  run_cpp_tests "$root" thread "$with_threads" || failed=1
  build_sanitized "$root" address,undefined ON || return 1
  run_cpp_tests "$root" address,undefined "$filter" || failed=1
  [[ $filter != '*' ]] || run_python_tests "$root" || failed=1
  return $failed
}

# The folder of a build; a comma in a path ends an option for the linker.
sanitized_folder() { echo "$1/.ws/sanitize/${2//,/-}"; }

# build_sanitized ROOT KIND WITH: WITH ROS and Python or without.
build_sanitized() {
  local root=$1 kind=$2 with=$3 build ros2=OFF
  build=$(sanitized_folder "$root" "$kind")
  [[ $with == OFF ]] || ! grep -qx ros2 "$root/.ws/groups" || ros2=ON
  mkdir -p "$(dirname "$build")"
  echo "[sanitize] building with -fsanitize=$kind in $build"
  # -Wno-tsan: ThreadSanitizer does not know fences. The frames in shared memory have some; their readers map the memory
  # a second time, so it does not compare the accesses anyway. Without the caller's workspaces, whose libraries are built
  # without sanitizers.
  env -u CMAKE_PREFIX_PATH -u ROS_PACKAGE_PATH -u PYTHONPATH -u LD_LIBRARY_PATH -u PKG_CONFIG_PATH \
    cmake -S "$root" -B "$build" -DBUBBLESIM_SANITIZE="$kind" -DBUBBLESIM_WITH_ROS="$with" -DBUBBLESIM_WITH_PYTHON="$with" \
    -DBUBBLESIM_WITH_ROS2="$ros2" -DBUBBLESIM_BUILD_NODES=OFF -DBUBBLESIM_NODE= -DBUBBLESIM_BUILD_TESTS=ON -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="-O1 -g1 -Wno-tsan" -DBUBBLESIM_VIRTUAL_ENV="$root/.ws/venv" > "$build.log" 2>&1 ||
    { cat "$build.log"; return 1; }
  env -u CMAKE_PREFIX_PATH -u ROS_PACKAGE_PATH -u PYTHONPATH -u LD_LIBRARY_PATH -u PKG_CONFIG_PATH \
    cmake --build "$build" -j "$(nproc)" >> "$build.log" 2>&1 || { tail -n 50 "$build.log"; return 1; }
  [[ $with == OFF ]] || ln -sfn "$root/.ws/devel/share/bubblesim/web" "$build/devel/share/bubblesim/web"  # the window's page
}

# Uses a build and its workspace, if it has ROS, not those of the caller; in a subshell.
use_sanitized() {
  local root=$1 build=$2
  unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH
  [[ -e $build/devel/setup.bash ]] || return 0
  set +u  # as in activate.bash
  # shellcheck disable=SC1091  # made by the build
  source "$build/devel/setup.bash"
  set -u
  export PATH=$root/.ws/venv/bin:/usr/bin:/bin:$PATH
}

# run_cpp_tests ROOT KIND FILTER: each program as often as there are cores, with a part of its tests each time.
run_cpp_tests() (
  local root=$1 kind=$2 filter=$3 build
  local suppressions=$root/tests/sanitizers
  build=$(sanitized_folder "$root" "$kind")
  use_sanitized "$root" "$build"
  export TSAN_OPTIONS="suppressions=$suppressions/thread.supp exitcode=66"
  export LSAN_OPTIONS="suppressions=$suppressions/leak.supp" UBSAN_OPTIONS="print_stacktrace=1 halt_on_error=1"
  export PYTHONMALLOC=malloc GTEST_BRIEF=1 GTEST_FILTER=$filter
  GTEST_TOTAL_SHARDS=$(nproc)
  export GTEST_TOTAL_SHARDS
  echo "[sanitize] $kind: C++ tests"
  find "$build/tests" "$build/devel/lib/bubblesim" -name 'test_*' -type f -executable ! -name '*.*' 2>/dev/null | sort |
    while read -r program; do
      for ((part = 0; part < GTEST_TOTAL_SHARDS; ++part)); do printf '%s\n' "$part" "$program"; done
    done | xargs -r -d '\n' -P "$GTEST_TOTAL_SHARDS" -n 2 bash -c 'run_cpp_program "$1" "$2"' bash
)

# run_cpp_program PART PROGRAM: prints its output when it has ended.
run_cpp_program() {
  local output status=0
  # ThreadSanitizer needs addresses that are not randomised.
  output=$(GTEST_SHARD_INDEX=$1 setarch -R "$2" 2>&1) || status=$?
  echo "$(basename "$2"), part $1: exit code $status"
  [[ $status -eq 0 ]] || echo "$output"
  return $status
}
export -f run_cpp_program

# The Python tests of what C++ does for Python and ROS. Reports go to files: some tests expect that a program fails.
run_python_tests() (
  local root=$1 build reports failed=0
  build=$(sanitized_folder "$root" address,undefined)
  reports=$build/reports
  rm -rf "$reports"
  mkdir -p "$reports"
  use_sanitized "$root" "$build"
  export BUBBLESIM_BUILD_DIR=$build/devel PYTHONMALLOC=malloc
  # Of Python, which is built without: libstdc++ too, because libasan takes the functions for exceptions from it.
  export LD_PRELOAD="$(gcc -print-file-name=libasan.so) $(gcc -print-file-name=libstdc++.so)"
  export UBSAN_OPTIONS="log_path=$reports/undefined print_stacktrace=1 halt_on_error=1"
  export LSAN_OPTIONS="suppressions=$root/tests/sanitizers/leak.supp print_suppressions=0 exitcode=0"
  # As malloc() without: scripts that ask for more than there is get a MemoryError. Fast DDS deletes an object of 88 bytes
  # as one of 56 when a writer ends, which ends the node. The C++ tests, which have no writers, keep that check.
  export ASAN_OPTIONS="log_path=$reports/address detect_leaks=1 allocator_may_return_null=1 new_delete_type_mismatch=0"
  export BUBBLESIM_TEST_DEADLINE_FACTOR=5
  cd "$root" || return 1
  echo "[sanitize] address,undefined: Python tests"
  # A process for each file, and more of them than cores, as without sanitizers: each looks for leaks at its end.
  find "${PYTHON_TESTS[@]}" -name 'test_*.py' | sort |
    xargs -P "$(($(nproc) + 2))" -I FILE bash -c 'run_python_file "$@"' bash FILE "${LEFT_OUT[@]/#/--deselect=}" || failed=1
  print_reports "$reports" "$root" || failed=1
  return $failed
)

# run_python_file FILE OPTION...: prints its output when it has ended.
run_python_file() {
  local output status=0
  output=$(python tests/sanitizers/run_pytest.py -q -p no:cacheprovider "$@" 2>&1) || status=$?
  echo "$1: $(tail -n 1 <<<"$output")"
  [[ $status -eq 0 ]] || echo "$output"
  return $status
}
export -f run_python_file

# print_reports FOLDER ROOT: returns 1 if there are any. Of leaks only those that code of the build has allocated:
# Python keeps some memory until its end, and its frames cannot be suppressed by name, because they call our code.
print_reports() {
  local report found=0
  for report in "$1"/*; do
    [[ -e $report ]] || continue
    grep -qE 'ERROR:|runtime error:' "$report" || continue  # an allocation that was refused is a warning
    if grep -q 'LeakSanitizer: detected' "$report"; then
      awk -v RS= -v ORS='\n\n' -v ours="$2" 'index($0, ours) { print; found = 1 } END { exit !found }' "$report" || continue
    else
      cat "$report"
    fi
    found=1
  done
  return $found
}
