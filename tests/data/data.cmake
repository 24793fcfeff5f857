# Every file of the test data, as a whole frame: on the recording device, and as a picture on a real one.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_data LABEL system TIMEOUT 900 LIBRARIES gnomon_sample
    SOURCES data/data_files.cpp system/data_folder_test.cpp)
  gnomon_tests(NAME gl_data LABEL gl TIMEOUT 900 LIBRARIES gnomon_sample
    SOURCES data/data_files.cpp gl/data_folder_gl_test.cpp)
endif()
