# embed_text(<target> TABLE <function> HEADER <header> FILES <path>...)
#
# Compiles the text of each file into <target>, as bvhbench::<function>(path), which <header> declares and which returns
# std::optional<std::string_view>. `path` is relative to the source root. Runs at build time: editing a file rebuilds one
# generated source and relinks. The text is stored as bytes, because string literals have length limits and delimiters.
function(embed_text target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TABLE;HEADER" "FILES")
    set(out "${CMAKE_CURRENT_BINARY_DIR}/${arg_TABLE}.cpp")
    list(TRANSFORM arg_FILES PREPEND "${PROJECT_SOURCE_DIR}/" OUTPUT_VARIABLE inputs)
    add_custom_command(
        OUTPUT "${out}"
        COMMAND ${CMAKE_COMMAND} "-DROOT=${PROJECT_SOURCE_DIR}" "-DFILES=${arg_FILES}" "-DOUT=${out}"
                "-DTABLE=${arg_TABLE}" "-DHEADER=${arg_HEADER}"
                -P "${PROJECT_SOURCE_DIR}/cmake/EmbedTextScript.cmake"
        DEPENDS ${inputs} "${PROJECT_SOURCE_DIR}/cmake/EmbedTextScript.cmake"
        COMMENT "Embedding text as ${arg_TABLE}"
        VERBATIM)
    target_sources(${target} PRIVATE "${out}")
endfunction()
