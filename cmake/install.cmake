# What `cmake --install` puts where, so that another project finds it with find_package(Gnomon): a library for each need, and
# the headers in include/gnomon. Each part is an export of its own: whoever asks for one needs its libraries alone.
include(cmake/install_core.cmake)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
foreach(part shadows assets ecs window)
  set_target_properties(gnomon_${part} PROPERTIES EXPORT_NAME ${part})
  install(TARGETS gnomon_${part} EXPORT Gnomon_${part} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT Gnomon_${part} NAMESPACE Gnomon:: FILE Gnomon_${part}.cmake DESTINATION ${GNOMON_PACKAGE_DIR})
endforeach()
add_custom_target(gnomon_installed DEPENDS gnomon_shadows gnomon_assets gnomon_ecs gnomon_window)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/find_libraries.cmake DESTINATION ${GNOMON_PACKAGE_DIR})
