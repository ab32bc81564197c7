# SPDX-License-Identifier: MIT
# Functions that the other scripts of this folder source.

failed=()

# step NAME COMMAND...: runs the command and prints its time. A failure is recorded, and the next step still runs. If `only` is set, it
# is an expression, and steps whose names it does not match are left out.
step() {
    local name=$1 start=$SECONDS status=0
    [[ $name =~ ${only:-} ]] || return 0
    shift
    printf '\n== %s: %s\n' "$name" "$*"
    "$@" || status=$?
    if ((status)); then
        failed+=("$name")
        printf '== %s: FAILED with %d after %d s\n' "$name" "$status" "$((SECONDS - start))"
    else
        printf '== %s: %d s\n' "$name" "$((SECONDS - start))"
    fi
}

# beside NAME COMMAND...: runs a step in parallel to the steps after it, until `awaited` prints its output.
beside() {
    beside_name=$1
    beside_log=$(mktemp)
    (
        failed=()
        step "$@"
        ((${#failed[@]} == 0))
    ) >"$beside_log" 2>&1 &
    beside_job=$!
}

awaited() {
    wait "$beside_job" || failed+=("$beside_name")
    cat "$beside_log"
    rm -f "$beside_log"
}

# Prints a line for each failed step, and returns their number.
say_failed() {
    local name
    for name in "${failed[@]}"; do
        printf 'FAILED: %s\n' "$name"
    done
    return ${#failed[@]}
}

# Prints the folder of real meshes, or nothing if there is none: BVHBENCH_DATA, or the output of `unpack` in a data folder beside
# the checkout (BVHBENCH_DATA_SOURCE, default ../shared/data).
find_data() {
    local unpack=${BVHBENCH_DATA_SOURCE:-../shared/data}/unpack
    if [[ -n ${BVHBENCH_DATA:-} ]]; then
        printf '%s\n' "$BVHBENCH_DATA"
    elif [[ -x $unpack ]]; then
        "$unpack"
    fi
}
