# What lights do to pictures, where visibility says nothing of it.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_pictures LABEL gl SOURCES
    parallel_light_gl_test.cpp
    picture_samples_gl_test.cpp
    picture_scale_gl_test.cpp
    shadow_catcher_gl_test.cpp
    unlit_gl_test.cpp
    LIBRARIES gnomon_sample gnomon_oracle)
endif()
# An engine that shares its context with Gnomon.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_manners LABEL gl SOURCES
    gl_state_record.cpp
    kept_state_gl_test.cpp
    manners_cost_gl_test.cpp
    manners_gl_test.cpp
    public_frame_gl_test.cpp
    spied_gl.cpp
    unusual_gl_state.cpp
    ../unit/allocation_counter.cpp
    LIBRARIES gnomon_sample PkgConfig::EPOXY)
endif()
