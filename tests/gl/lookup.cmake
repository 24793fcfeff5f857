# One program for all lights.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_lookup LABEL gl SOURCES
    lookup_gl_test.cpp
    lookup_hardware_gl_test.cpp
    shared_layers_gl_test.cpp
    LIBRARIES gnomon_sample gnomon_oracle PkgConfig::EPOXY)
endif()
