# add_build_info(<target>): compiles the commit, whether the tree had local changes, the compiler and the build type into <target>
# (harness/base/build_info.h). Every build checks them, and rewrites the source only if they changed.
function(add_build_info target)
    set(out "${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp")
    add_custom_target(${target}_build_info
        COMMAND ${CMAKE_COMMAND} "-DROOT=${PROJECT_SOURCE_DIR}" "-DOUT=${out}"
                "-DVERSION=${PROJECT_VERSION}"
                "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
                "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}" "-DARCH=${BVHBENCH_ARCH}"
                -P "${PROJECT_SOURCE_DIR}/cmake/BuildInfoScript.cmake"
        BYPRODUCTS "${out}"
        VERBATIM)
    target_sources(${target} PRIVATE "${out}")
    add_dependencies(${target} ${target}_build_info)
endfunction()
