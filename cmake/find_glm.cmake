# glm::glm, from GLM's own CMake package; without one, from wherever its headers are found. Used by the build and by the
# installed package.
find_package(glm CONFIG QUIET)
if(NOT TARGET glm::glm)
  find_path(GNOMON_GLM_INCLUDE_DIR glm/glm.hpp)
  if(GNOMON_GLM_INCLUDE_DIR)
    add_library(glm::glm INTERFACE IMPORTED GLOBAL)
    set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${GNOMON_GLM_INCLUDE_DIR}")
  endif()
endif()
