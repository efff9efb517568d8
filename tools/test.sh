#!/usr/bin/env bash
# Builds everything and runs the tests with the default compiler: the layers' suites in f32, shapes, scenes and tools in both
# precisions.
#   tools/test.sh [--sanitizers] [--long] [--werror]
# --sanitizers adds the same tests by clang 14: those labelled quick with the address and undefined behaviour sanitizers,
# those labelled parallel with thread sanitizer. `.ci/run` does so for every change.
# --long adds all of that, the tests labelled long (also all suites in f64, which sanitizers then run, too), all random
# cases of the others (else some try a third), a minute of each fuzzer (tests/fuzz), the solver's suite built without
# optimisation (kernels for several instruction sets once shared functions there, and crashed), and the same bits on other
# machines (tools/portability.sh).
# --werror (also: CI=true in the environment) makes warnings errors.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

long=no
sanitizers=no
werror=OFF
if [ "${CI:-}" = true ]; then werror=ON; fi
for argument in "$@"; do
    case "$argument" in
        --long) long=yes sanitizers=yes ;;
        --sanitizers) sanitizers=yes ;;
        --werror) werror=ON ;;
        -h | --help) sed -n '2,11s/^# \?//p' "${BASH_SOURCE[0]}" && exit 0 ;;
        *) fail "unknown argument $argument (see --help)" ;;
    esac
done

if [ "$long" = no ]; then export SWEPT_FEW_CASES=1; fi

"$root/tools/setup.sh"
started=$SECONDS
summary="$root/build/test-summary.txt"
mkdir -p "$log_dir"
: >"$summary"
failed=no

# run_tests PRESET TITLE CTEST-ARGUMENT...: runs tests and keeps ctest's own summary for the end.
run_tests() {
    local preset="$1" title="$2"
    shift 2
    local log="$log_dir/ctest-$preset.log"
    say "$title: running the tests"
    ctest --test-dir "$root/build/$preset" --parallel "$(nproc)" --output-on-failure --no-tests=error "$@" \
        >"$log" 2>&1 || failed=yes
    # From the first failure on, with the failed test's output; never the list of what passed.
    grep -vE '^ *(Start +[0-9]+:|[0-9]+/[0-9]+ Test +#[0-9]+: .*( Passed |\*\*\*Skipped ))' "$log" |
        sed -n '/\*\*\*/,/tests passed/p' | head -n 120 || true
    {
        printf '%s\n' "$title"
        sed -n '/tests passed/p; /^The following tests FAILED/,/^Errors while/p; /^No tests were found/p' "$log"
    } >>"$summary"
}

# build_and_test PRESET TITLE LABEL: a sanitizer pass over the tests with one label.
build_and_test() {
    local preset="$1" title="$2" label="$3"
    say "$title: configuring and building (build/$preset)"
    configure "$preset" -DSWEPT_BUILD_TESTS=ON -DSWEPT_WERROR="$werror"
    build "$preset" "swept_tests_$label"
    if ctest --test-dir "$root/build/$preset" -N -L "^$label\$" | grep -q '^Total Tests: 0$'; then
        printf '%s\nno test is labelled %s yet\n' "$title" "$label" >>"$summary"
        return
    fi
    run_tests "$preset" "$title" -L "^$label\$"
}

# fuzz: each fuzzer for a minute, from the corpus in tests/fuzz; what it finds stays in build/fuzz.
fuzz() {
    local target
    say "libFuzzer: configuring and building (build/fuzz)"
    configure fuzz -DSWEPT_BUILD_TESTS=ON -DSWEPT_WERROR="$werror"
    build fuzz swept_fuzzers
    for target in scene hull toi world; do
        local found="$root/build/fuzz/found/$target"
        mkdir -p "$found"
        say "libFuzzer: $target"
        if "$root/build/fuzz/tests/fuzz/swept_fuzz_$target" -max_total_time=60 -timeout=20 -artifact_prefix="$found-" \
            "$found" "$root/tests/fuzz/corpus/$target" >"$log_dir/fuzz-$target.log" 2>&1; then
            printf 'fuzzer %s: nothing found in a minute\n' "$target" >>"$summary"
        else
            printf 'fuzzer %s: FAILED, see build/logs/fuzz-%s.log\n' "$target" "$target" >>"$summary"
            failed=yes
        fi
    done
}

say "default compiler: configuring and building everything (build/release)"
if [ "$long" = yes ]; then long_tests=ON; else long_tests=OFF; fi
configure release -DSWEPT_BUILD_TESTS=ON -DSWEPT_LONG_TESTS="$long_tests" -DSWEPT_TESTS_APART="$long_tests" \
    -DSWEPT_WERROR="$werror"
build release all
run_tests release "default compiler, release, f32 and f64"

if [ "$sanitizers" = yes ]; then
    export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
    export LSAN_OPTIONS="suppressions=$PWD/tests/leaks_of_libraries.txt:print_suppressions=0:${LSAN_OPTIONS:-}"
    build_and_test asan "clang 14, address and undefined behaviour sanitizers, tests labelled quick" quick
    if [ "$long" = yes ]; then
        build_and_test asan "clang 14, address and undefined behaviour sanitizers, tests labelled quick_long" quick_long
    fi
    if [ "$long" = yes ]; then fuzz; fi
    build_and_test tsan "clang 14, thread sanitizer, tests labelled parallel" parallel
    if [ "$long" = yes ]; then
        build_and_test tsan "clang 14, thread sanitizer, tests labelled parallel_long" parallel_long
    fi
fi

if [ "$long" = yes ]; then
    say "default compiler, not optimised: configuring and building the solver's suite (build/debug)"
    configure debug -DSWEPT_BUILD_TESTS=ON -DSWEPT_WERROR="$werror"
    build debug solver_tests_f32 solver_tests_f64
    run_tests debug "default compiler, not optimised, tests of the solver" -R '^solver_tests_f(32|64)[.]'

    say "WebAssembly, 64-bit ARM, Windows: building, and running under Node.js, qemu and Wine; plain C++"
    "$root/tools/portability.sh" >"$log_dir/portability.log" 2>&1 || failed=yes
    grep -v '^==>' "$log_dir/portability.log" >>"$summary" || true
fi

printf '\n'
cat "$summary"
printf 'took %d s; logs are in build/logs\n' $((SECONDS - started))
[ "$failed" = no ]
