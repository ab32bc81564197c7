# precompiled_headers(<name> [OPTIONS <option>...] [LIBRARIES <target>...] HEADERS <header>...): precompiles these headers for
# precompile(<target> <name>), which also gives the options to the target's sources. Standard library headers and bindings are a
# quarter of a source's compile time.
#
# Sources still include what they use: the presets dev and sanitize switch precompilation and unity builds off and would not compile
# otherwise.
option(BVHBENCH_PRECOMPILE "Compile the headers of libraries once" ${PROJECT_IS_TOP_LEVEL})

function(precompiled_headers name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "OPTIONS;LIBRARIES;HEADERS")
    set_property(GLOBAL PROPERTY options_of_${name} "${arg_OPTIONS}")
    if(BVHBENCH_PRECOMPILE)
        set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
        file(CONFIGURE OUTPUT "${source}" CONTENT "// Nothing but what is precompiled.\n")
        add_library(${name} OBJECT "${source}")
        target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} project_flags)
        target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
        target_compile_options(${name} PRIVATE ${arg_OPTIONS})
        target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
    endif()
endfunction()

function(precompile target name)
    get_property(options GLOBAL PROPERTY options_of_${name})
    target_compile_options(${target} PRIVATE ${options})
    if(BVHBENCH_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM ${name})
        # GCC 12 then reports false copies in inlined parts of std::string's operator+, as for -Wno-restrict.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-array-bounds>)
    endif()
endfunction()

# Headers that ten or more sources include.
set(usual_headers <algorithm> <array> <bit> <cassert> <chrono> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional>
    <iostream> <iterator> <limits> <map> <memory> <numeric> <optional> <random> <set> <span> <sstream> <stdexcept> <string>
    <string_view> <thread> <utility> <vector> "${PROJECT_SOURCE_DIR}/device/cl.h")
