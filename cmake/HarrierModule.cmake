# One function for every folder of the house: a static library with the project's flags, and a target that
# compiles alone each header that no source includes first, so that a header never leans on what its includer happened to
# include (sources include their own header first: tests/tooling/shape.py).

add_library(harrier_flags INTERFACE)
target_include_directories(harrier_flags INTERFACE ${CMAKE_SOURCE_DIR})
# -ffp-contract=off: LOD decisions must be bit-identical on every machine (docs/conventions.md).
target_compile_options(harrier_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wsign-conversion
                       $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Werror -ffp-contract=off)
# GCC 12 sees overlapping copies in std::string's operator+ that are not there (GCC bug 105651).
target_compile_options(harrier_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# GCC 12's SLP vectoriser drops the rounding in `hi = float(x); lo = float(x - hi)` over three axes, which the
# two-float positions live on (tests/lod/draw_list_test.cpp).
target_compile_options(harrier_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
target_compile_definitions(harrier_flags INTERFACE GLM_FORCE_XYZW_ONLY GLM_FORCE_EXPLICIT_CTOR)

# harrier_module(NAME SOURCES... HEADERS... LINK...)
function(harrier_module name)
    cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;LINK" ${ARGN})
    if(ARG_SOURCES)
        add_library(harrier_${name} STATIC ${ARG_SOURCES})
        target_link_libraries(harrier_${name} PUBLIC harrier_flags ${ARG_LINK})
    else()  # headers only
        add_library(harrier_${name} INTERFACE)
        target_link_libraries(harrier_${name} INTERFACE harrier_flags ${ARG_LINK})
    endif()

    set(probes)
    foreach(header ${ARG_HEADERS})
        string(REGEX REPLACE "\\.h$" ".cpp" own_source ${header})
        if(EXISTS ${own_source})
            continue()
        endif()
        cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE from_root)
        string(MAKE_C_IDENTIFIER ${from_root} id)
        set(probe ${CMAKE_BINARY_DIR}/headers/${id}.cpp)
        if(NOT EXISTS ${probe})
            file(WRITE ${probe} "#include \"${from_root}\"  // compiles alone\n")
        endif()
        list(APPEND probes ${probe})
    endforeach()
    if(HARRIER_TESTS AND probes)
        add_library(harrier_${name}_headers OBJECT ${probes})
        target_link_libraries(harrier_${name}_headers PRIVATE harrier_${name})
    endif()
endfunction()
