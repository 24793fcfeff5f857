# Casters that move and bend, as files have them, against rays on the bent mesh; and meshes that come and go.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_living LABEL gl SOURCES
    living_casters_gl_test.cpp
    streaming_gl_test.cpp
    ../system/test_world.cpp
    LIBRARIES gnomon_sample gnomon_oracle)
endif()
