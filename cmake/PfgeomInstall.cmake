# `cmake --install BUILD --component development`: headers, libraries, and the package pfgeom with its target
# pfgeom::core. examples/cpp uses it so.

include(CMakePackageConfigHelpers)

set(_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pfgeom)
set_target_properties(pfgeom_core PROPERTIES EXPORT_NAME core)
set_target_properties(pfgeom_options PROPERTIES EXPORT_NAME options)

install(TARGETS pfgeom_core pfgeom_options ${PFGEOM_LIBRARIES} EXPORT pfgeom
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY native/pfgeom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
    FILES_MATCHING PATTERN "*.h")
install(EXPORT pfgeom NAMESPACE pfgeom:: DESTINATION ${_package_dir} COMPONENT development)

configure_package_config_file(cmake/pfgeomConfig.cmake.in pfgeomConfig.cmake INSTALL_DESTINATION ${_package_dir})
write_basic_package_version_file(pfgeomConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pfgeomConfig.cmake ${PROJECT_BINARY_DIR}/pfgeomConfigVersion.cmake
    DESTINATION ${_package_dir} COMPONENT development)
install(FILES LICENSE NOTICES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
