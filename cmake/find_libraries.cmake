# Libraries that do not bring a CMake package everywhere. Where pkg-config knows them, as on Debian, it says how to use
# them; elsewhere their files are looked for on CMake's own paths, which is how vcpkg lays them out. Either way they
# become PkgConfig::<PREFIX>. Used by the build and by the installed package.
find_package(PkgConfig QUIET)

# gnomon_find_library(EPOXY MODULE epoxy HEADER epoxy/gl.h LIBRARIES epoxy)
# Sets <PREFIX>_FOUND; without LIBRARIES a header is all there is.
macro(gnomon_find_library prefix)
  cmake_parse_arguments(gnomon_wanted "" "MODULE;HEADER" "LIBRARIES" ${ARGN})
  set(${prefix}_FOUND ${PkgConfig_FOUND})
  if(PkgConfig_FOUND AND NOT TARGET PkgConfig::${prefix})
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET GLOBAL ${gnomon_wanted_MODULE})
  endif()
  if(NOT TARGET PkgConfig::${prefix})
    find_path(${prefix}_HEADER_FOLDER ${gnomon_wanted_HEADER})
    set(${prefix}_FOUND ${${prefix}_HEADER_FOLDER})
    set(gnomon_found_files)
    foreach(gnomon_library IN LISTS gnomon_wanted_LIBRARIES)
      find_library(${prefix}_FILE_${gnomon_library} NAMES ${gnomon_library} ${gnomon_library}d)
      list(APPEND gnomon_found_files ${${prefix}_FILE_${gnomon_library}})
      if(NOT ${prefix}_FILE_${gnomon_library})
        set(${prefix}_FOUND FALSE)
      endif()
    endforeach()
    if(${prefix}_FOUND)
      add_library(PkgConfig::${prefix} INTERFACE IMPORTED GLOBAL)
      set_target_properties(PkgConfig::${prefix} PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${${prefix}_HEADER_FOLDER}" INTERFACE_LINK_LIBRARIES "${gnomon_found_files}")
    endif()
  endif()
endmacro()

# What the engine links.
gnomon_find_library(EPOXY MODULE epoxy HEADER epoxy/gl.h LIBRARIES epoxy)
gnomon_find_library(EGL MODULE egl HEADER EGL/egl.h LIBRARIES EGL)
gnomon_find_library(OPENMESH MODULE openmesh HEADER OpenMesh/Core/Mesh/TriConnectivity.hh
  LIBRARIES OpenMeshCore OpenMeshTools)
# A library on Debian; upstream and vcpkg have the header alone, which the engine then compiles itself.
gnomon_find_library(TINYGLTF MODULE tinygltf HEADER tiny_gltf.h LIBRARIES tinygltf)
set(GNOMON_COMPILES_TINYGLTF FALSE)
if(NOT TARGET PkgConfig::TINYGLTF)
  gnomon_find_library(TINYGLTF MODULE tinygltf HEADER tiny_gltf.h)
  set(GNOMON_COMPILES_TINYGLTF ${TINYGLTF_FOUND})
endif()

set(GNOMON_MISSING_LIBRARIES)
foreach(prefix EPOXY EGL OPENMESH TINYGLTF)
  if(NOT TARGET PkgConfig::${prefix})
    string(TOLOWER ${prefix} module)
    list(APPEND GNOMON_MISSING_LIBRARIES ${module})
  endif()
endforeach()
