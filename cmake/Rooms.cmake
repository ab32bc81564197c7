# add_room(<name> [NEEDS <room>...] [OWNS <prefix>...] [LIBRARIES <target>...]
#          [FLOORS <folder>...] [SOURCES <file>...] [HEADERS <file>...] [KERNELS <file>...])
#
# A room is a folder, a library and a rule. Its files may include, by path from the source root, only
# their own headers and those of the rooms they NEED. A library's headers (<CL/...>, <assimp/...>) may be
# included only by a room that OWNS their prefix; two do where both read or write files of that kind.
# tests/sources_test.py reads the rules back from rooms.json, so this call is the only place where they are
# written.
#
# FLOORS lists the folders of a large room, the lowest first: a file may include those of its own folder and of folders before
# it. "." is the room's folder itself.
#
# KERNELS lists every file that kernels are made of: .cl entry points and the headers they include.
# Entry points (.cl) are also syntax-checked, each alone, by cmake/KernelChecks.cmake.
function(add_room name)
    cmake_parse_arguments(PARSE_ARGV 1 room "" "" "NEEDS;OWNS;LIBRARIES;FLOORS;SOURCES;HEADERS;KERNELS")
    if(room_SOURCES)
        add_library(${name} STATIC ${room_SOURCES})
        set(visibility PUBLIC)
        target_link_libraries(${name} PRIVATE project_flags)
        precompile(${name} precompiled)
    else()
        add_library(${name} INTERFACE)
        set(visibility INTERFACE)
    endif()
    target_sources(${name} ${visibility}
        FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${room_HEADERS})
    target_link_libraries(${name} ${visibility} ${room_NEEDS} ${room_LIBRARIES})
    list(TRANSFORM room_KERNELS PREPEND "${name}/")
    set_property(GLOBAL APPEND PROPERTY BVHBENCH_KERNELS ${room_KERNELS})
    set_property(TARGET ${name} PROPERTY BVHBENCH_KERNELS ${room_KERNELS})

    foreach(list NEEDS OWNS FLOORS)
        list(TRANSFORM room_${list} REPLACE "(.+)" "\"\\1\"")
        list(JOIN room_${list} ", " room_${list})
    endforeach()
    set_property(GLOBAL APPEND PROPERTY BVHBENCH_ROOMS
        "\"${name}\": {\"needs\": [${room_NEEDS}], \"owns\": [${room_OWNS}], \"floors\": [${room_FLOORS}]}")
endfunction()

# Write the rules down and gather the kernels of all rooms into one object library, `kernels`, which
# every program links: no static-library linker can drop it. Call once, after the last room.
function(close_rooms)
    get_property(rooms GLOBAL PROPERTY BVHBENCH_ROOMS)
    list(JOIN rooms ",\n  " rooms)
    file(WRITE "${PROJECT_BINARY_DIR}/rooms.json" "{\n  ${rooms}\n}\n")
    get_property(kernels GLOBAL PROPERTY BVHBENCH_KERNELS)
    add_library(kernels OBJECT)
    embed_text(kernels TABLE embedded_kernel HEADER device/sources.h FILES ${kernels})
    target_link_libraries(kernels PRIVATE device project_flags)
endfunction()

# embed_rooms(<target> <room>...): compile all there is of these rooms into <target>, and no other's kernels: a library that
# needs none of their own.
function(embed_rooms target)
    set(kernels "")
    foreach(room IN LISTS ARGN)
        get_target_property(type ${room} TYPE)
        if(NOT type STREQUAL "INTERFACE_LIBRARY")
            target_sources(${target} PRIVATE $<TARGET_OBJECTS:${room}>)
        endif()
        get_target_property(of_room ${room} BVHBENCH_KERNELS)
        list(APPEND kernels ${of_room})
    endforeach()
    embed_text(${target} TABLE embedded_kernel HEADER device/sources.h FILES ${kernels})
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
endfunction()
