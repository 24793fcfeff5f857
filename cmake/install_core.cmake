# What `cmake --install` puts where of Gnomon::core, and the package's own files. With `--component core` nothing else is.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(GNOMON_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/gnomon)
set(GNOMON_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Gnomon)

# Its one header is <gnomon/core.h>.
set_target_properties(gnomon_core PROPERTIES EXPORT_NAME core)
target_include_directories(gnomon_core INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS gnomon_core EXPORT Gnomon_core ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
install(FILES ${PROJECT_SOURCE_DIR}/include/gnomon/core.h DESTINATION ${GNOMON_INCLUDE_DIR} COMPONENT core)
install(EXPORT Gnomon_core NAMESPACE Gnomon:: FILE Gnomon_core.cmake DESTINATION ${GNOMON_PACKAGE_DIR} COMPONENT core)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/GnomonConfig.cmake.in
  ${PROJECT_BINARY_DIR}/GnomonConfig.cmake INSTALL_DESTINATION ${GNOMON_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GnomonConfig.cmake ${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/find_glm.cmake DESTINATION ${GNOMON_PACKAGE_DIR} COMPONENT core)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon COMPONENT core)
