# SPDX-License-Identifier: MIT
# What the scripts beside this one share; they source it.

failed=()

# step NAME COMMAND...: runs it, with its time; a failure is remembered and the next step still runs.
step() {
    local name=$1 start=$SECONDS status=0
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

# beside NAME COMMAND...: a step that runs beside those after it, until `awaited` prints what it said.
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

# A line for each step that failed; how many they are is the status.
say_failed() {
    local name
    for name in "${failed[@]}"; do
        printf 'FAILED: %s\n' "$name"
    done
    return ${#failed[@]}
}

# Prints the folder of real meshes, or nothing: BVHBENCH_DATA, or what a data folder beside the checkout
# (BVHBENCH_DATA_SOURCE, default ../shared/data) unpacks.
find_data() {
    local unpack=${BVHBENCH_DATA_SOURCE:-../shared/data}/unpack
    if [[ -n ${BVHBENCH_DATA:-} ]]; then
        printf '%s\n' "$BVHBENCH_DATA"
    elif [[ -x $unpack ]]; then
        "$unpack"
    fi
}
