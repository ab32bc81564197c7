# Interface target with the options that all files of the project are compiled with.
add_library(project_flags INTERFACE)
target_compile_options(project_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion
    -Wno-missing-field-initializers  # designated initializers leave the other members to their defaults
    # Where sources are compiled together, one may hide a global name of another.
    $<IF:$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>,-Wshadow=local,-Wshadow>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 reports false overlaps in std::string's operator+
    # GCC's garbage collection below 600 MB would take a tenth of the compile time.
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=600000>
    $<$<BOOL:${BVHBENCH_ARCH}>:-march=${BVHBENCH_ARCH}>
    # Boxes and codes are compared bit for bit with the device's; a fused multiply-add would change them.
    -ffp-contract=off
    $<$<BOOL:${BVHBENCH_WERROR}>:-Werror>)
