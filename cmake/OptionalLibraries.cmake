# optional_library(<NAME> <package> <version> [<other>...]): finds a library that only some builders, a check or a program needs,
# and the other packages that these need with it.
#
# BVHBENCH_WITH_<NAME> is AUTO (use it if it is found), ON (fail without it) or OFF. Sets BVHBENCH_HAS_<NAME> to 1 or 0. Without
# the library its builders are still listed, with the reason why they are unavailable.
macro(optional_library name package version)
    set(BVHBENCH_WITH_${name} AUTO CACHE STRING "Parts that need ${package} ${version}: AUTO, ON or OFF")
    set_property(CACHE BVHBENCH_WITH_${name} PROPERTY STRINGS AUTO ON OFF)
    set(BVHBENCH_HAS_${name} 0)
    if(BVHBENCH_WITH_${name})
        set(how REQUIRED)
        if(BVHBENCH_WITH_${name} STREQUAL "AUTO")
            set(how QUIET)
        endif()
        set(BVHBENCH_HAS_${name} 1)
        find_package(${package} ${version} ${how})
        foreach(other ${ARGN})
            find_package(${other} ${how})
        endforeach()
        foreach(needed ${package} ${ARGN})
            if(NOT ${needed}_FOUND)
                set(BVHBENCH_HAS_${name} 0)
            endif()
        endforeach()
    endif()
endmacro()
