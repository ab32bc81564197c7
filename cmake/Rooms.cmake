# Sets the variable to all files below the folder that end in one of these ways, and looks again at each build.
function(files_of variable)
    list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/*." OUTPUT_VARIABLE patterns)
    file(GLOB_RECURSE found RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" CONFIGURE_DEPENDS ${patterns})
    set(${variable} ${found} PARENT_SCOPE)
endfunction()

# add_room(<name> [NEEDS <room>...] [OWNS <prefix>...] [LIBRARIES <target>...]
#          [FLOORS <folder>...] [ALONE <file>...] [ELSEWHERE <start>...] [KERNEL_HEADERS <file>...])
#
# A room is a folder, a library and a rule. Its files include, by path from the source root, only their own headers and
# those of the rooms in NEEDS. Headers of an external library (<CL/...>, <assimp/...>) are included only by rooms that OWN
# their prefix; two rooms own one if both read or write files of that kind. tests/sources_test.py reads the rules from
# rooms.json, so they are written only in these calls.
#
# FLOORS lists the folders of a large room, the lowest first. A file may include files of its own folder and of folders
# before it. "." is the room's folder itself.
#
# In a unity build (preset release) the sources of a folder are compiled as one, so names in their unnamed namespaces differ.
# ALONE lists sources that are compiled alone there too: those that a test program has its own of, or that need what a program that
# never calls them is not linked with.
#
# Sources, headers and kernels are what the folder has. ELSEWHERE are paths, or beginnings of paths, whose sources other targets
# compile or that need an optional library. KERNEL_HEADERS lists the C headers that kernels include, besides all .cl and .clh files.
# cmake/KernelChecks.cmake checks the syntax of each .cl file.
function(add_room name)
    cmake_parse_arguments(PARSE_ARGV 1 room "" "" "NEEDS;OWNS;LIBRARIES;FLOORS;ALONE;ELSEWHERE;KERNEL_HEADERS")
    files_of(room_SOURCES cpp)
    files_of(room_HEADERS h)
    foreach(start IN LISTS room_ELSEWHERE)
        list(FILTER room_SOURCES EXCLUDE REGEX "^${start}")
        list(FILTER room_HEADERS EXCLUDE REGEX "^${start}")
    endforeach()
    list(REMOVE_ITEM room_SOURCES ${room_ALONE})
    files_of(room_KERNELS cl clh)
    list(APPEND room_KERNELS ${room_KERNEL_HEADERS})
    list(SORT room_KERNELS)
    if(room_SOURCES)
        add_library(${name} STATIC ${room_SOURCES} ${room_ALONE})
        set_target_properties(${name} PROPERTIES UNITY_BUILD_MODE GROUP)
        foreach(source IN LISTS room_SOURCES)
            get_filename_component(folder "${source}" DIRECTORY)
            string(MAKE_C_IDENTIFIER "of_${folder}" group)
            set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
        endforeach()
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

# Writes the rules to rooms.json, and gathers the kernels of all rooms in one object library, `kernels`, for every program: the
# linker cannot drop it, as it could drop a static library. Must be called once, after the last room.
function(close_rooms)
    get_property(rooms GLOBAL PROPERTY BVHBENCH_ROOMS)
    list(JOIN rooms ",\n  " rooms)
    file(WRITE "${PROJECT_BINARY_DIR}/rooms.json" "{\n  ${rooms}\n}\n")
    get_property(kernels GLOBAL PROPERTY BVHBENCH_KERNELS)
    add_library(kernels OBJECT)
    embed_text(kernels TABLE embedded_kernel HEADER device/sources.h FILES ${kernels})
    target_link_libraries(kernels PRIVATE device project_flags)
endfunction()

# embed_rooms(<target> <room>... [KERNELS_OF <room>...]): compiles these rooms, and only their kernels and those of the last, into
# <target>: a library that needs no other library of the project.
function(embed_rooms target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "KERNELS_OF")
    embed_objects(${target} ${arg_UNPARSED_ARGUMENTS})
    set(kernels "")
    foreach(room IN LISTS arg_UNPARSED_ARGUMENTS arg_KERNELS_OF)
        get_property(of_room TARGET ${room} PROPERTY BVHBENCH_KERNELS)
        list(APPEND kernels ${of_room})
    endforeach()
    embed_text(${target} TABLE embedded_kernel HEADER device/sources.h FILES ${kernels})
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
endfunction()

# embed_objects(<target> <room>...): compiles these rooms into <target>, without their kernels.
function(embed_objects target)
    foreach(room IN LISTS ARGN)
        get_target_property(type ${room} TYPE)
        if(NOT type STREQUAL "INTERFACE_LIBRARY")
            target_sources(${target} PRIVATE $<TARGET_OBJECTS:${room}>)
        endif()
    endforeach()
endfunction()
