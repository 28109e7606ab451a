# What tests load into programs to make their files fail. Not under sanitizers, which want to be loaded first themselves.
add_library(farcell_io_faults MODULE ${CMAKE_CURRENT_LIST_DIR}/io_faults.cpp)
target_link_libraries(farcell_io_faults PRIVATE farcell_settings ${CMAKE_DL_LIBS})
set_target_properties(farcell_io_faults PROPERTIES PREFIX "" OUTPUT_NAME io-faults
                      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
