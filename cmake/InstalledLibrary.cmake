# installed_library(<name> EXPORT <set> HEADER <file> PC <file.pc.in>): finishes the target bvhbench_<name>, whose sources are set, as a
# library of the package: bvhbench::<name>, of the file bvhbench-<name> with hyphens, with one public header below include/bvhbench
# of the current folder. Installs both, and a file for pkg-config.
include(GNUInstallDirs)
function(installed_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXPORT;HEADER;PC" "")
    set(target bvhbench_${name})
    add_library(bvhbench::${name} ALIAS ${target})
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PUBLIC
        $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    # Not linked: whoever links the library is compiled with flags of his own.
    target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:project_flags,INTERFACE_COMPILE_OPTIONS>)
    string(REPLACE "_" "-" file "bvhbench-${name}")
    set_target_properties(${target} PROPERTIES
        EXPORT_NAME ${name}
        OUTPUT_NAME ${file}
        VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    if(NOT BVHBENCH_INSTALL)
        return()
    endif()
    install(TARGETS ${target} EXPORT ${arg_EXPORT})
    install(FILES "include/bvhbench/${arg_HEADER}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/bvhbench")
    install(EXPORT ${arg_EXPORT} NAMESPACE bvhbench:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/bvhbench")
    # Found from where the file lies, so that what is installed may be moved.
    cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" OUTPUT_VARIABLE BVHBENCH_PC_UP)
    configure_file(${arg_PC} ${file}.pc @ONLY)
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${file}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()
