# add_kernel_checks(): adds tests that compile each kernel entry point (.cl) in each dialect by clang, without a device, and one
# that it uses no built-in function missing in device/builtins.clh.
#
# The host defines a kernel's compile-time constants (-D). The check reads them from the kernel file: each line
# `// check: -DGROUP_SIZE=64u ...` near its top gives one set of values.
function(add_kernel_checks)
    find_program(KERNEL_CLANG NAMES clang-14 clang REQUIRED)
    get_property(kernels GLOBAL PROPERTY BVHBENCH_KERNELS)
    list(FILTER kernels INCLUDE REGEX "\\.cl$")
    foreach(kernel IN LISTS kernels)
        file(STRINGS "${PROJECT_SOURCE_DIR}/${kernel}" lines REGEX "^// check:")
        if(NOT lines)
            set(lines "// check:")
        endif()
        string(REGEX REPLACE "[/.]" "_" name "${kernel}")
        set(variant 0)
        foreach(line IN LISTS lines)
            string(REPLACE "// check:" "" defines "${line}")
            separate_arguments(defines UNIX_COMMAND "${defines}")
            foreach(dialect CL1.2 CL3.0)
                add_test(NAME kernel.${name}.${variant}.${dialect}
                    COMMAND ${KERNEL_CLANG} -x cl -cl-std=${dialect} -Xclang -finclude-default-header
                            -fsyntax-only -Wall -Wextra -Werror ${defines}
                            "-I${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/${kernel}")
            endforeach()
            at_night(kernel.${name}.${variant}.CL1.2)  # by day the next one stands for it
            # With device/builtins.clh alone, as in programs for PoCL 3.1 (device/program.cpp).
            add_test(NAME kernel.${name}.${variant}.builtins
                COMMAND ${KERNEL_CLANG} -x cl -cl-std=CL1.2 -cl-no-stdinc -include opencl-c-base.h
                        -include "${PROJECT_SOURCE_DIR}/device/builtins.clh"
                        -fsyntax-only -Wall -Wextra -Werror ${defines}
                        "-I${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/${kernel}")
            math(EXPR variant "${variant} + 1")
        endforeach()
    endforeach()
endfunction()
