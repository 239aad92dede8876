# libpng, zlib and zstd as static libraries whose symbols a shared library can keep to itself.

function(geoidx_find_static name)
    string(TOUPPER ${name} upper)
    find_library(GEOIDX_STATIC_${upper} NAMES lib${name}.a)
    if(NOT GEOIDX_STATIC_${upper})
        message(FATAL_ERROR "lib${name}.a is missing: install it, or set GEOIDX_BUNDLE_DEPENDENCIES to OFF")
    endif()
endfunction()

foreach(name png16 z zstd)
    geoidx_find_static(${name})
endforeach()

add_library(geoidx_bundled INTERFACE)
target_link_libraries(geoidx_bundled INTERFACE ${GEOIDX_STATIC_PNG16} ${GEOIDX_STATIC_Z} ${GEOIDX_STATIC_ZSTD}
                                               $<$<NOT:$<BOOL:${WIN32}>>:m>)
