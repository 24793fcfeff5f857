# gnomon::Shadows beside an engine with a renderer of its own.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_embed LABEL gl SOURCES
    embed_air_gl_test.cpp
    embed_buffers_gl_test.cpp
    embed_contexts_gl_test.cpp
    embed_drawables_gl_test.cpp
    embed_gl_test.cpp
    embed_layers_gl_test.cpp
    embed_lookup_gl_test.cpp
    embed_state_gl_test.cpp
    embed_tint_gl_test.cpp
    embed_views_gl_test.cpp
    shared_layers_gl_test.cpp
    failing_gl.cpp
    gl_state_record.cpp
    unusual_gl_state.cpp
    ../unit/allocation_counter.cpp
    LIBRARIES gnomon_sample gnomon_oracle PkgConfig::EPOXY)
endif()
