#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests of each preset named (default: release).
# usage: tests/run.sh [release|asan|tsan|dev ...]
# The last line is "N passed, N failed, N skipped" over all presets; the exit code is 0 only when nothing failed.
# Warnings are errors when CI is set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."

presets=("$@")
((${#presets[@]} > 0)) || presets=(release)
for preset in "${presets[@]}"; do
  case $preset in
    release | asan | tsan | dev) ;;
    *)
      echo "tests/run.sh: unknown preset '$preset'; expected release, asan, tsan or dev" >&2
      exit 2
      ;;
  esac
done

passed=0 failed=0 skipped=0

# Adds the counts in the head of a JUnit report, where skipped tests are among the tests.
count() {
  local report=$1 name value tests=0 failures=0 absent=0 idle=0
  while read -r name value; do
    case $name in
      tests) tests=$value ;;
      failures) failures=$value ;;
      disabled) absent=$value ;;
      skipped) idle=$value ;;
    esac
  done < <(tr '\n\t' '  ' <"$report" | grep -oE -m1 '<testsuite [^>]*>' |
    grep -oE ' (tests|failures|disabled|skipped)="[0-9]+"' | tr -d '"' | tr '=' ' ')
  passed=$((passed + tests - failures - absent - idle))
  failed=$((failed + failures))
  skipped=$((skipped + absent + idle))
  ((tests > 0))
}

# The thread sanitizer of GCC 12 cannot live with many random address bits: it is run without them where that is allowed.
calm=()
if setarch -R true 2>/dev/null; then calm=(setarch -R); fi

runPreset() {
  local preset=$1 report start=$SECONDS
  local wrap=()
  [[ $preset != tsan ]] || wrap=("${calm[@]}")
  report="$PWD/build/$preset/junit.xml"
  echo "== $preset: configure and build" >&2
  cmake --preset "$preset" -DFARCELL_TESTS=ON >&2 || return 1
  "${wrap[@]}" cmake --build --preset "$preset" -j 2 >&2 || return 1
  echo "== $preset: built in $((SECONDS - start)) s; tests" >&2
  rm -f "$report"
  # A failing test is counted from the report; ctest that made no report failed itself.
  "${wrap[@]}" ctest --preset "$preset" --output-junit "$report" >&2 || true
  [[ -s $report ]] && count "$report" || return 1
  echo "== $preset: done in $((SECONDS - start)) s" >&2
}

tools/install-deps.sh --tests
for preset in "${presets[@]}"; do
  if ! runPreset "$preset"; then
    echo "== $preset: did not get as far as running tests" >&2
    failed=$((failed + 1))
  fi
done

echo "$passed passed, $failed failed, $skipped skipped"
((failed == 0))
