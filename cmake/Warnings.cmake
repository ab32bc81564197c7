# One interface target carries what every file of the project is compiled with.
add_library(project_flags INTERFACE)
target_compile_options(project_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 sees overlaps in std::string's operator+ that are not there
    # A tenth of what compiling takes: it need not look for memory to take back before there are 600 MB.
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=600000>
    $<$<BOOL:${BVHBENCH_ARCH}>:-march=${BVHBENCH_ARCH}>
    # Boxes and codes are compared bit for bit with the device's; a fused multiply-add would change them.
    -ffp-contract=off
    $<$<BOOL:${BVHBENCH_WERROR}>:-Werror>)
