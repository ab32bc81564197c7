#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes our readers with libFuzzer under the address and undefined-behaviour sanitizers:
#   tests/fuzz/fuzz.sh SECONDS [READER...]      each reader so long; all of tests/fuzz/corpus by default
#
# Readers are compiled by clang with its instruments, into build/fuzz; all else comes from build/release, which must stand. Its
# libraries hold the readers too, many sources in an object, so the linker takes the first definition of each, which is clang's.
# Exits 1 if something is found: it lies in build/fuzz as crash-*; make it a test, and then a seed. Needs libclang-rt-14-dev besides packages.txt.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
seconds=${1:?how many seconds a reader}
shift
(($#)) || set -- $(ls tests/fuzz/corpus)
from=build/release
to=build/fuzz
mkdir -p "$to"

flags=(-std=c++20 -O1 -g1 -march=x86-64-v3 -fsanitize=address,undefined -fno-sanitize-recover=undefined -I.
    -DBVHBENCH_HAS_CGAL=1 -DBVHBENCH_HAS_EMBREE=1 -DBVHBENCH_HAS_FCL=1 '-DBVHBENCH_EXPERIMENTS="fig8"'
    '-DBVHBENCH_TUNINGS="none.json"')
objects=()
for source in scenes/formats/{formats,gltf,gltf_file,gltf_nodes,obj,off,ply,ply_header,polygons,stl,text}.cpp scenes/{catalog,doubles,face_order,facts,finish,ground_truth,mesh_file,sequence,sequence_facts}.cpp \
    harness/choice/{choices,experiment,experiment_lists,scene_choice}.cpp plugins/protocol.cpp \
    harness/base/json_keys.cpp harness/commands/{program,words}.cpp harness/session/tuning_file.cpp; do
    object=$to/${source//\//_}.o
    objects+=("$object")
    [[ $object -nt $source ]] || clang++-14 "${flags[@]}" -fsanitize=fuzzer-no-link -c "$source" -o "$object"
done
libraries=()
for room in harness plugins cluster scenes process baselines collide oibvh builders device geometry; do
    libraries+=("$from/$room/lib$room.a")
done
libraries+=($(find "$from/CMakeFiles/kernels.dir" -name "*.o") -lOpenCL -llzma -lre2 -lassimp -lembree3 -lfcl -lccd -lgmp -lmpfr -ltbb -lmpi -lpthread -ldl)
found=0
for reader in "$@"; do
    clang++-14 "${flags[@]}" -fsanitize=fuzzer -Wl,-z,muldefs -DREADER="$reader" tests/fuzz/reader.cpp "${objects[@]}" "${libraries[@]}" \
        -o "$to/$reader"
    mkdir -p "$to/corpus/$reader"
    echo "== $reader"
    "$to/$reader" -max_total_time="$seconds" -max_len=4096 -rss_limit_mb=1500 -timeout=10 -artifact_prefix="$to/" \
        -print_final_stats=1 "$to/corpus/$reader" "tests/fuzz/corpus/$reader" >"$to/$reader.log" 2>&1 || found=1
    grep -E "ERROR|SUMMARY|Uncaught|runtime error|Test unit|number_of_executed_units|^Done" "$to/$reader.log" || true
done
exit $found
