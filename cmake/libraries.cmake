# The libraries, by what they need. Folders add their sources; each library links what its users have to link, and no more.
# Users see include/gnomon. What lies elsewhere is seen by Gnomon's own files: gnomon_sources.
find_package(Threads REQUIRED)  # visibility queries, where a caller asks for several

add_library(gnomon_sources INTERFACE)
target_include_directories(gnomon_sources INTERFACE
  ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/generated)

foreach(part shadows assets ecs window)
  add_library(gnomon_${part} STATIC)
  add_library(Gnomon::${part} ALIAS gnomon_${part})
  target_link_libraries(gnomon_${part} PUBLIC gnomon_core PRIVATE $<BUILD_INTERFACE:gnomon_options> $<BUILD_INTERFACE:gnomon_sources>)
endforeach()
target_link_libraries(gnomon_shadows PRIVATE PkgConfig::EPOXY Threads::Threads)
target_link_libraries(gnomon_assets PRIVATE PkgConfig::OPENMESH PkgConfig::TINYGLTF $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
target_include_directories(gnomon_assets SYSTEM PRIVATE ${STB_INCLUDE_DIR})
target_link_libraries(gnomon_ecs PUBLIC gnomon_shadows)
target_link_libraries(gnomon_window PRIVATE PkgConfig::EPOXY PkgConfig::EGL glfw)
target_include_directories(gnomon_window SYSTEM PRIVATE ${STB_INCLUDE_DIR})

# All of it, for the game, the bench and the tests.
add_library(gnomon_inside INTERFACE)
target_link_libraries(gnomon_inside INTERFACE gnomon_sources gnomon_truth gnomon_ecs gnomon_assets gnomon_window gnomon_shadows)
