# What `cmake --install` and `cpack` give.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/geoidx)

install(FILES include/geoidx.h include/geoidx.hpp TYPE INCLUDE)
install(TARGETS geoidx EXPORT geoidx)
install(TARGETS geoidx_static EXPORT geoidx_static)
install(EXPORT geoidx NAMESPACE geoidx:: FILE geoidxTargets.cmake DESTINATION ${package_folder})
install(EXPORT geoidx_static NAMESPACE geoidx:: FILE geoidxStaticTargets.cmake DESTINATION ${package_folder})
if(GEOIDX_BUILD_TOOLS)
    set_target_properties(geoidx_tool PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    install(TARGETS geoidx_tool)
endif()

configure_package_config_file(cmake/geoidxConfig.cmake.in ${PROJECT_BINARY_DIR}/geoidxConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/geoidxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/geoidxConfig.cmake ${PROJECT_BINARY_DIR}/geoidxConfigVersion.cmake
        DESTINATION ${package_folder})
# An installed folder may be moved, unless its parts are given by absolute paths.
file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(GEOIDX_PC_PREFIX "\${pcfiledir}/${up}")
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(GEOIDX_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
endif()
foreach(folder LIBDIR INCLUDEDIR)
    set(GEOIDX_PC_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}}")
    if(IS_ABSOLUTE "${CMAKE_INSTALL_${folder}}")
        set(GEOIDX_PC_${folder} "${CMAKE_INSTALL_${folder}}")
    endif()
endforeach()
foreach(package geoidx geoidx-static)
    configure_file(cmake/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
# Debian's policy has all notices in one file of this name.
file(READ LICENSE license)
file(READ THIRD-PARTY-NOTICES.txt notices)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright CONTENT "@license@\n\n@notices@" @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS LICENSE THIRD-PARTY-NOTICES.txt)
install(FILES ${PROJECT_BINARY_DIR}/copyright TYPE DOC)
install(FILES LICENSE THIRD-PARTY-NOTICES.txt README.md CHANGELOG.md format/SPEC.md TYPE DOC)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME geoidx)
set(CPACK_PACKAGE_VENDOR geoidx)
set(CPACK_PACKAGE_CONTACT "the geoidx authors <geoidx@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Geodesic distances on triangle meshes, precomputed")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libpng-dev, libzstd-dev") # of the static library
include(CPack)
