# Tests that need Gnomon::core alone: cmake/core_only.cmake builds the same files, and .ci/check_core runs them with every
# compiler.
set(GNOMON_CORE_TESTS core_fits_test.cpp core_conventions_test.cpp core_bias_test.cpp core_status_test.cpp core_air_test.cpp)
list(TRANSFORM GNOMON_CORE_TESTS PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
