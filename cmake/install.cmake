# What `cmake --install` puts where, so that another project finds it with find_package(Gnomon).
# Headers keep their paths from the project's root, below include/gnomon: "systems/frame.h" is one name on both sides.
include(cmake/install_core.cmake)

# The engine's own parts (loader, executor) stay inside: their headers would drag tinygltf and OpenGL's along.
set(GNOMON_ENGINE_HEADERS
  engine/assets/animation.h
  engine/assets/deformer.h
  engine/assets/gltf_loader.h
  engine/assets/mesh_library.h
  engine/assets/mesh_shape.h
  engine/assets/mesh_topology.h
  engine/assets/scene_data.h
  engine/assets/surface_edges.h
  engine/core/range_list.h
  engine/gl/commands.h
  engine/gl/device.h
  engine/gl/device_gl45.h
  engine/gl/device_recording.h
  engine/gl/handles.h
  engine/gl/shader_source.h
  engine/math/aabb.h
  engine/math/bounds_tree.h
  engine/math/bvh.h
  engine/math/cone.h
  engine/math/convex_polygon.h
  engine/math/frustum.h
  engine/math/projection.h
  engine/math/shape_tree.h
  engine/platform/context.h
  engine/rays/bvh.h
  engine/rays/exact_triangle.h
  engine/rays/mesh_bvh.h
  engine/rays/ray_packet.h
  engine/rays/trace.h)
list(TRANSFORM GNOMON_ENGINE_HEADERS PREPEND ${PROJECT_SOURCE_DIR}/)
target_sources(gnomon_engine PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${GNOMON_ENGINE_HEADERS})
target_sources(gnomon_shaders PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}
  FILES ${PROJECT_SOURCE_DIR}/shaders/embedded.h)
foreach(part engine shaders systems window)
  target_include_directories(gnomon_${part} INTERFACE $<INSTALL_INTERFACE:${GNOMON_INCLUDE_DIR}>)
endforeach()
# The public face: <gnomon/shadows.h> and those beside it. It includes some of what lies below include/gnomon/, too.
foreach(part systems window)
  target_include_directories(gnomon_${part} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

foreach(part engine shaders systems window)
  set_target_properties(gnomon_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()
install(TARGETS gnomon_engine gnomon_shaders EXPORT GnomonTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${GNOMON_INCLUDE_DIR})
install(TARGETS gnomon_systems gnomon_window EXPORT GnomonTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# Systems are public whole: whoever brings an own frame may take any stage. Found when they are installed:
# headers found when the build is configured would have to be looked for anew at every start.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/systems DESTINATION ${GNOMON_INCLUDE_DIR}
  FILES_MATCHING PATTERN "*.h")
# Made by shaders/CMakeLists.txt; no file set, whose folders may not lie in each other.
install(FILES ${PROJECT_BINARY_DIR}/generated/shaders/bindings.h DESTINATION ${GNOMON_INCLUDE_DIR}/shaders)
add_custom_target(gnomon_installed DEPENDS gnomon_engine gnomon_shaders gnomon_systems gnomon_window)
install(EXPORT GnomonTargets NAMESPACE Gnomon:: DESTINATION ${GNOMON_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/cmake/find_libraries.cmake DESTINATION ${GNOMON_PACKAGE_DIR})
